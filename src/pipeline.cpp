#include "onset/pipeline.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>

#include "base/parallel.hpp"
#include "broadphase/motion_box.hpp"
#include "scene/primitive_filter.hpp"
#include "src/checked_options.hpp"
#include "src/contact_rows.hpp"
#include "src/pass.hpp"
#include "src/scene.hpp"

namespace onset {
namespace {

// One block in so many is sampled: fewer of many, as a few hundred tell as much.
constexpr std::size_t kManyBlocks = 512;
std::size_t sampled_stride(const BroadPhase& broad) {
  return broad.blocks(PairKind::vertex_face) + broad.blocks(PairKind::edge_edge) < kManyBlocks ? 64 : 256;
}
constexpr double kShrinksUpTo = 0.5;        // horizon: beyond it, new boxes cost more than they spare

// Limiting pair only: a sample of the blocks bounds the earliest time of impact, the boxes shrink to that horizon, and the whole is
// passed once with a horizon that shrinks further. What is reported at t is within Scene::reach of what it must keep then, unless it
// spends its checks, so boxes that are wider by that on [0, horizon] lose none that is reported by then: the result is the minimum of
// the active set. What the sample found counts whatever the boxes say.
//
// Within a window: whatever the sample finds bounds the earliest contact, and the window begins there. A pair that is out of checks
// says too little for either: whether its boxes meet by then is another matter.
double shrink_to_horizon(const Mesh& mesh, Scene& scene, const NarrowPhase& narrow, const Options& options, Keep keep,
                         Budget& budget, Limits& sampled) {
  if (!narrow.uses_horizon()) return 1;
  sampled = run_pass(*scene.broad, narrow, Keep::limiting, 1, budget, sampled_stride(*scene.broad)).limits;
  if (!sampled.contact) return 1;
  sampled.stored = sampled.clear = {};  // the whole finds them
  const PairResult& first = sampled.contact->result;
  if (first.outcome == Outcome::budget) return 1;
  // Where times are exact, a contact in the same bracket is as early: its boxes must meet too.
  const double limit = narrow.times_are_exact() ? std::nextafter(first.step_limit, 2) : first.step_limit;
  const double horizon = keep == Keep::all ? latest_time(first) + options.window : limit;
  if (horizon > kShrinksUpTo) return std::min(horizon, 1.0);
  BroadPhaseInput shrunk =
      keep == Keep::all
          ? broad_phase_input(mesh.data(), scene.motion, options, scene.reach, horizon, BoxTest::motion)
          : *scene.tree;
  shrunk.horizon = horizon;
  shrunk.test = BoxTest::motion;
  scene.broad->refit(shrunk);
  return horizon;
}

// The exact times of those that can be the earliest: none of the others is before the least toi_hi.
void sharpen_earliest(const NarrowPhase& narrow, std::vector<FoundPair>& found) {
  double latest = INFINITY;
  for (const FoundPair& f : found)
    if (f.result.outcome != Outcome::initial_separating) latest = std::min(latest, f.result.toi_hi);
  for (FoundPair& f : found)
    if (f.result.toi <= latest && f.result.toi_hi > f.result.toi) narrow.sharpen(f.kind, f.result);
}

// 256 bytes a contact: a row of the set is 124; finding it takes 64 in arrays that grow to twice that, and
// sorting it 32 and 64 more.
constexpr std::int64_t kBytesAContact = 256;

std::size_t most_contacts(const Options& options) {
  return std::size_t(options.memory_limit / kBytesAContact);
}

// One contact more than fits, where there is a limit: it tells until when the set is complete.
PassBounds bounds(const Options& options) {
  const bool limited = options.memory_limit < std::numeric_limits<std::int64_t>::max();
  return {options.window, limited ? most_contacts(options) + 1 : std::numeric_limits<std::size_t>::max()};
}

// Whether the boxes of the whole step, as an active set has them, let a pair meet.
bool is_candidate(const void* scene, PairKind kind, IdPair pair) {
  return boxes_pass(*static_cast<const Scene*>(scene)->whole, kind, pair);
}

PassResult run(const Mesh& mesh, Scene& scene, const Options& options, Keep keep, Budget& budget, Stats& stats) {
  const double begun = scene.clock.seconds();
  const PassBounds limited = keep == Keep::all ? bounds(options) : PassBounds{};
  NarrowPhaseInput input{mesh.data(), scene.motion, stats.tolerance, stats.extent, options};
  // All times in one order are exact, or none is.
  input.exact_times = options.certainty == CertaintyLevel::exact &&
                      (keep != Keep::all || limited.most < std::numeric_limits<std::size_t>::max());
  // A pass over all vertices in every call is worth it unless most of them are static.
  input.for_many = 2 * mesh.data().filter->static_ids.size() <= std::size_t(mesh.data().num_vertices);
  const PairPredicate contacts{&scene, is_candidate};
  if (keep == Keep::limiting) {
    input.stored = true;
    input.rounding = scene.rounding;
    input.contacts = &contacts;
  }
  const NarrowPhase narrow(input);
  const bool shrinks = keep == Keep::limiting || (keep == Keep::all && options.window < 1);
  Limits sampled;
  const double horizon = shrinks ? shrink_to_horizon(mesh, scene, narrow, options, keep, budget, sampled) : 1;
  PassBounds limits = limited;
  if (horizon <= kShrinksUpTo) limits.whole = &*scene.tree;
  PassResult pass = run_pass(*scene.broad, narrow, keep, horizon, budget, 1, limits);
  if (keep == Keep::limiting) pass.limits.add(sampled);
  if (keep == Keep::all) sharpen_earliest(narrow, pass.found);
  copy_counts(pass, stats);
  stats.seconds_narrow = scene.clock.seconds() - begun;
  stats.seconds_total = scene.clock.seconds();
  return pass;
}

StepResult step_in_arena(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1,
                         const Options& options, Keep keep) {
  StepResult r;
  Budget budget(options);
  const Scene::Use use = keep == Keep::limiting ? Scene::Use::stored_step : Scene::Use::contacts;
  Scene scene(mesh, x_t0, x_t1, options, use, r.stats, budget);
  r.outcome = scene.motion.status;
  r.vertex = scene.motion.bad_vertex;
  if (r.outcome != Outcome::free) return r;
  const PassResult pass = scene.broad ? run(mesh, scene, options, keep, budget, r.stats) : PassResult{};
  limit_step(mesh, pass, budget, 1, 1, r);
  r.rounding = reported_rounding(scene.rounding);
  r.stats.seconds_total = scene.clock.seconds();
  return r;
}

}  // namespace

StepResult compute_collision_free_stepsize(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1,
                                           const Options& options) {
  check(options);
  StepResult r;
  in_arena(options.threads, [&] { r = step_in_arena(mesh, x_t0, x_t1, options, Keep::limiting); });
  return r;
}

bool is_step_collision_free(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1,
                            const Options& options) {
  check(options);
  StepResult r;
  in_arena(options.threads, [&] { r = step_in_arena(mesh, x_t0, x_t1, options, Keep::any); });
  return r.outcome == Outcome::free && r.toi > 1;
}

namespace {

// The window and the memory limit cut off, in the order (toi, kind, a, b), what is later.
void cut_off(std::vector<FoundPair>& found, const Options& options, const Budget& budget, ActiveSet& set) {
  set.complete_until = std::numeric_limits<double>::infinity();
  set.outcome = budget.outcome();
  if (!found.empty() && options.window < 1) {
    double earliest = found[0].result.toi;
    for (const FoundPair& f : found) earliest = std::min(earliest, f.result.toi);
    set.complete_until = earliest + options.window;
    found.erase(std::remove_if(found.begin(), found.end(),
                               [&](const FoundPair& f) { return f.result.toi > set.complete_until; }),
                found.end());
  }
  if (const std::size_t most = most_contacts(options); found.size() > most) {
    std::nth_element(found.begin(), found.begin() + std::ptrdiff_t(most), found.end(), earlier);
    set.complete_until = found[most].result.toi;
    if (set.outcome == Outcome::free) set.outcome = Outcome::out_of_memory;
    found.resize(most);
    std::sort(found.begin(), found.end(), before);
  }
  if (budget.outcome() != Outcome::free) set.complete_until = 0;
}

}  // namespace

ActiveSet construct_active_set(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1,
                               const Options& options) {
  check(options);
  ActiveSet set;
  in_arena(options.threads, [&] {
    Budget budget(options);
    Scene scene(mesh, x_t0, x_t1, options, Scene::Use::contacts, set.stats, budget);
    set.outcome = scene.motion.status;
    set.vertex = scene.motion.bad_vertex;
    if (set.outcome != Outcome::free) return;
    PassResult pass = scene.broad ? run(mesh, scene, options, Keep::all, budget, set.stats) : PassResult{};
    const double begun = scene.clock.seconds();
    note_worst(mesh, pass, set.stats);
    cut_off(pass.found, options, budget, set);
    if (budget.outcome() != Outcome::free) set.stats.looked_at = budget.done();
    fill_rows(mesh, scene.motion, options.kernel, pass.found, set);
    if (set.size() > 0 && set.outcome == Outcome::free) set.outcome = Outcome::contact;
    set.stats.seconds_total = scene.clock.seconds();
    set.stats.seconds_contacts = set.stats.seconds_total - begun;
  });
  return set;
}

namespace {

// Nothing is listed any more once `room` (pairs) is used up. `welds`: where it is not null, seams of it are left out.
void list_candidates(const Mesh& mesh, const BroadPhase& broad, PairKind kind, bool list, const Motion* welds,
                     std::atomic<std::int64_t>& room, Budget& budget, std::vector<std::array<int, 2>>& pairs,
                     std::int64_t& count) {
  std::mutex mutex;
  struct Task {
    const MeshData& mesh;
    PairKind kind;
    bool list;
    const Motion* welds;
    std::atomic<std::int64_t>& room;
    Budget& budget;
    std::int64_t count;
    std::vector<std::array<int, 2>> pairs;
    static void consume(void* context, const IdPair* p, std::size_t n) {
      auto& task = *static_cast<Task*>(context);
      if (task.budget.spent()) return;
      if (task.welds != nullptr) return task.consume_unwelded(p, n);
      task.count += std::int64_t(n);
      if (task.list && (task.room -= std::int64_t(n)) >= 0)
        for (std::size_t i = 0; i < n; ++i) task.pairs.push_back({p[i].a, p[i].b});
    }
    void consume_unwelded(const IdPair* p, std::size_t n) {
      for (std::size_t i = 0; i < n; ++i) {
        if (is_seam(*welds, kind, pair_vertices(mesh, kind, p[i]))) continue;
        ++count;
        if (list && --room >= 0) pairs.push_back({p[i].a, p[i].b});
      }
    }
  };
  parallel_ranges(broad.blocks(kind), 64, [&](std::size_t first, std::size_t last) {
    Task task{mesh.data(), kind, list, welds, room, budget, 0, {}};
    if (!budget.spent()) broad.traverse(kind, first, last, {&task, &Task::consume});
    if (!budget.spent()) budget.advance(last - first);
    const std::lock_guard<std::mutex> lock(mutex);
    count += task.count;
    pairs.insert(pairs.end(), task.pairs.begin(), task.pairs.end());
  });
  parallel_sort(pairs.begin(), pairs.end(), [](const auto& p, const auto& q) { return p < q; });
}

}  // namespace

Candidates compute_candidates(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1,
                              const Options& options, bool list) {
  check(options);
  Candidates c;
  in_arena(options.threads, [&] {
    Budget budget(options);
    Scene scene(mesh, x_t0, x_t1, options, Scene::Use::candidates, c.stats, budget);
    c.outcome = scene.motion.status;
    c.vertex = scene.motion.bad_vertex;
    if (c.outcome != Outcome::free) return;
    std::atomic<std::int64_t> room{options.memory_limit / std::int64_t(sizeof(IdPair))};
    if (scene.broad) {
      budget.begin_pass(scene.broad->blocks(PairKind::vertex_face) +
                        scene.broad->blocks(PairKind::edge_edge));
      const Motion* welds = mesh.data().weld ? &scene.motion : nullptr;
      list_candidates(mesh, *scene.broad, PairKind::vertex_face, list, welds, room, budget, c.vertex_face,
                      c.counts.vertex_face);
      list_candidates(mesh, *scene.broad, PairKind::edge_edge, list, welds, room, budget, c.edge_edge,
                      c.counts.edge_edge);
    }
    c.outcome = room < 0 ? Outcome::out_of_memory : budget.outcome();
    if (c.outcome != Outcome::free) c.vertex_face = c.edge_edge = {};
    if (budget.outcome() != Outcome::free) c.stats.looked_at = budget.done();
    c.stats.swept = c.counts;
    c.stats.seconds_total = scene.clock.seconds();
    c.stats.seconds_broad = c.stats.seconds_total;
  });
  return c;
}

}  // namespace onset
