#include "src/shared/find_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "broadphase/motion_box.hpp"
#include "scene/primitive_filter.hpp"

namespace onset {
namespace {

// One block in so many is sampled: fewer of many, as a few hundred tell as much.
constexpr std::size_t kManyBlocks = 512;
std::size_t sampled_stride(const BroadPhase& broad) {
  return broad.blocks(PairKind::vertex_face) + broad.blocks(PairKind::edge_edge) < kManyBlocks ? 64 : 256;
}
constexpr double kShrinksUpTo = 0.5;        // t_max: beyond it, new boxes cost more than they spare

// Limiting pair only: a sample of the blocks bounds the earliest time of impact, the boxes shrink to t_max, and the whole is
// passed once with t_max that shrinks further. What is reported at t is within StepSetup::reach of what it must keep then, unless it
// spends its checks, so boxes that are wider by that on [0, t_max] lose none that is reported by then: the result is the minimum of
// the active set. What the sample found counts whatever the boxes say.
//
// Within a window: whatever the sample finds bounds the earliest contact, and the window begins there. A pair that is out of checks
// says too little for either: whether its boxes meet by then is another matter.
double shrink_to_t_max(const Mesh& mesh, StepSetup& setup, const NarrowPhase& narrow, const Options& options, Collect collect,
                         Budget& budget, Limits& sampled) {
  if (!narrow.uses_t_max()) return 1;
  sampled = traverse_pairs(*setup.broad, narrow, Collect::first, 1, budget, sampled_stride(*setup.broad)).limits;
  if (!sampled.contact) return 1;
  sampled.stored = sampled.clear = {};  // the whole finds them
  const PairResult& first = sampled.contact->result;
  if (first.outcome == PairOutcome::max_checks) return 1;
  // Where times are exact, a contact in the same bracket is as early: its boxes must meet too.
  const double limit = narrow.times_are_exact() ? std::nextafter(first.step_limit, 2) : first.step_limit;
  const double t_max = collect == Collect::all ? latest_time(first) + options.window : limit;
  if (t_max > kShrinksUpTo) return std::min(t_max, 1.0);
  BroadPhaseInput shrunk =
      collect == Collect::all
          ? broad_phase_input(mesh.data(), setup.motion, options, setup.reach, t_max, BoxTest::both_ends)
          : *setup.tree;
  shrunk.t_max = t_max;
  shrunk.test = BoxTest::both_ends;
  setup.broad->refit(shrunk);
  return t_max;
}

// The exact times of those that can be the earliest: none of the others is before the least toi_hi.
void sharpen_earliest(const NarrowPhase& narrow, std::vector<FoundPair>& found) {
  double latest = INFINITY;
  for (const FoundPair& f : found)
    if (f.result.outcome != PairOutcome::initial_separating) latest = std::min(latest, f.result.toi_hi);
  for (FoundPair& f : found)
    if (f.result.toi <= latest && f.result.toi_hi > f.result.toi) narrow.sharpen(f.kind, f.result);
}

// One contact more than fits, where there is a limit: it tells until when the set is complete.
TraversalBounds bounds(const Options& options) {
  const bool limited = options.memory_limit < std::numeric_limits<std::int64_t>::max();
  return {options.window, limited ? most_contacts(options) + 1 : std::numeric_limits<std::size_t>::max()};
}

// Whether the boxes of the whole step, as an active set has them, let a pair meet.
bool is_candidate(const void* setup, PairKind kind, IdPair pair) {
  return boxes_overlap(*static_cast<const StepSetup*>(setup)->whole, kind, pair);
}

}  // namespace

// 256 bytes a contact: a row of the set is 124; finding it takes 64 in arrays that grow to twice that, and
// sorting it 32 and 64 more.
constexpr std::int64_t kBytesAContact = 256;

std::size_t most_contacts(const Options& options) {
  return std::size_t(options.memory_limit / kBytesAContact);
}

TraversalResult find_contacts(const Mesh& mesh, StepSetup& setup, const Options& options, Collect collect, Budget& budget, Stats& stats) {
  const double begun = setup.clock.seconds();
  const TraversalBounds limited = collect == Collect::all ? bounds(options) : TraversalBounds{};
  NarrowPhaseInput input{mesh.data(), setup.motion, setup.accuracy.tolerance, setup.accuracy.extent, options};
  // All times in one order are exact, or none is.
  input.exact_times = options.exactness == Exactness::exact &&
                      (collect != Collect::all || limited.most < std::numeric_limits<std::size_t>::max());
  // A pass over all vertices in every call is worth it unless most of them are static.
  input.for_many = 2 * mesh.data().filter->static_ids.size() <= std::size_t(mesh.data().num_vertices);
  const PairPredicate contacts{&setup, is_candidate};
  if (collect == Collect::first) {
    input.stored = true;
    input.rounding = setup.rounding;
    input.contacts = &contacts;
  }
  const NarrowPhase narrow(input);
  const bool shrinks = collect == Collect::first || (collect == Collect::all && options.window < 1);
  Limits sampled;
  const double t_max = shrinks ? shrink_to_t_max(mesh, setup, narrow, options, collect, budget, sampled) : 1;
  TraversalBounds limits = limited;
  if (t_max <= kShrinksUpTo) limits.whole = &*setup.tree;
  TraversalResult traversal = traverse_pairs(*setup.broad, narrow, collect, t_max, budget, 1, limits);
  if (collect == Collect::first) traversal.limits.add(sampled);
  if (collect == Collect::all) sharpen_earliest(narrow, traversal.found);
  copy_counts(traversal, stats);
  stats.seconds_narrow = setup.clock.seconds() - begun;
  stats.seconds_total = setup.clock.seconds();
  return traversal;
}

}  // namespace onset
