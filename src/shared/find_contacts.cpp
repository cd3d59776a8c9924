#include "src/shared/find_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "broadphase/motion_box.hpp"
#include "scene/pairs/whole_scene.hpp"
#include "scene/primitive_filter.hpp"
#include "src/planes/plane_contacts.hpp"

namespace onset {
namespace {

// Returns one of how many blocks is sampled. Of many blocks fewer will do: a few hundred tell as much.
constexpr std::size_t kManyBlocks = 512;
std::size_t sampled_stride(const BroadPhase& broad) { return all_blocks(broad) < kManyBlocks ? 64 : 256; }
// With a t_max beyond this, new boxes cost more than they spare.
constexpr double kShrinksUpTo = 0.5;

// With so many pairs a primitive, boxes of a part of the step spare more than they cost.
constexpr std::int64_t kManyPairs = 16;
std::int64_t mesh_size(const MeshData& mesh) {
  return std::int64_t(mesh.num_vertices) + std::int64_t(mesh.edges.size()) + std::int64_t(mesh.faces.size());
}

struct Shrunk {
  double t_max = 1;
  bool boxes = false;
};

// Bounds the earliest contact by a sample of the blocks, shrinks the boxes to that time, and returns it as
// t_max. A pair that is reported at t with checks left is within StepSetup::reach of its separation then
// (docs/theory.md, L18), so boxes wider by that on [0, t_max] lose none that is reported by then. A pair of
// the sample that ran out of checks bounds nothing, as its boxes need not meet by then.
//
// For a limiting pair, the result is then the first of the active set; what the sample found counts whatever
// the boxes say. With a window, t_max is where the window of the first contact found ends. `known` is such a
// time already, that of a plane. New boxes for it alone are made where there are many pairs.
Shrunk shrink_to_t_max(const Mesh& mesh, StepSetup& setup, const NarrowPhase& narrow, const Options& options,
                       Collect collect, double known, Budget& budget, Limits& sampled) {
  if (!narrow.uses_t_max()) return {};
  double t_max = std::min(known, 1.0);
  const std::size_t stride = sampled_stride(*setup.broad);
  const TraversalResult sample = traverse_pairs(*setup.broad, narrow, Collect::first, t_max, budget, stride);
  sampled = sample.limits;
  if (!sampled.contact && known > 1) return {};
  sampled.stored = sampled.clear = {};  // the second traversal finds them
  if (sampled.contact && sampled.contact->result.outcome != PairOutcome::max_checks) {
    const PairResult& first = sampled.contact->result;
    // Where times are exact, a contact between the same two doubles is as early: its boxes must meet too.
    const double limit = narrow.times_are_exact() ? std::nextafter(first.step_limit, 2) : first.step_limit;
    t_max = std::min(t_max, collect == Collect::all ? latest_time(first) + options.window : limit);
  }
  const std::int64_t pairs =
      (sample.vertex_face.candidates + sample.edge_edge.candidates + sample.vertex_edge.candidates) *
      std::int64_t(stride);
  const bool pays = t_max < known || pairs > kManyPairs * mesh_size(mesh.data());
  if (t_max > kShrinksUpTo || !pays) return {t_max, false};
  BroadPhaseInput shrunk = collect == Collect::all ? broad_phase_input(mesh.data(), setup.motion, options,
                                                                       setup.reach, t_max, BoxTest::both_ends)
                                                   : *setup.tree;
  shrunk.t_max = t_max;
  shrunk.test = BoxTest::both_ends;
  setup.broad->refit(shrunk, budget.stop());
  return {t_max, true};
}

// Sets up the narrow phase, but for what only a traversal needs.
NarrowPhaseInput narrow_phase_input(const Mesh& mesh, const StepSetup& setup, const Options& options,
                                    Collect collect, const TraversalBounds& limited) {
  NarrowPhaseInput input{mesh.data(), setup.motion, setup.accuracy.tolerance, setup.accuracy.extent, options};
  // Where times are compared, all are exact or none is.
  input.exact_times = options.exactness == Exactness::exact &&
                      (collect != Collect::all || limited.most < std::numeric_limits<std::size_t>::max());
  input.rest = setup.rest.get();
  return input;
}

void sharpen(const NarrowPhase& narrow, double latest, std::vector<FoundPair>& found, Budget& budget) {
  for (FoundPair& f : found)
    if (f.kind != PairKind::vertex_plane && f.result.toi <= latest && f.result.toi_hi > f.result.toi) {
      if (budget.interrupted()) return;
      narrow.sharpen(f.kind, f.result);
    }
}

// Keeps one contact more than fits where there is a limit: it tells until when the set is complete.
TraversalBounds bounds(const Options& options) {
  const bool limited = options.memory_limit < std::numeric_limits<std::int64_t>::max();
  return {options.window, limited ? most_contacts(options) + 1 : std::numeric_limits<std::size_t>::max()};
}

// Returns until when pairs matter, by the contacts of planes; their times are exact.
double t_max_of(const PlaneContacts& planes, const Options& options) {
  double t_max = INFINITY;
  if (planes.limits.contact) t_max = std::nextafter(planes.limits.contact->result.step_limit, 2);
  for (const FoundPair& f : planes.found) t_max = std::min(t_max, latest_time(f.result) + options.window);
  return t_max;
}

// Adds what was found of planes, which come last in order; of more than `most` the earliest, or some where
// time or the caller ends that.
void add_planes(std::vector<FoundPair>&& of_planes, std::size_t most, Budget& budget,
                std::vector<FoundPair>& found) {
  if (found.empty()) found.swap(of_planes);
  if (of_planes.empty()) return;
  const Stop stop = budget.interruption();
  if (found.size() + of_planes.size() <= most) {
    found.reserve(found.size() + of_planes.size());
    each_unless(stop, 0, of_planes.size(), [&](std::size_t i) { found.push_back(of_planes[i]); });
    return;
  }
  FoundPairs all(most);
  for (std::vector<FoundPair>* from : {&found, &of_planes}) {
    const std::vector<FoundPair> list = std::move(*from);  // given back before the next one is copied
    for (std::size_t i = 0; i < list.size() && !stop.requested();) {
      const PairKind kind = list[i].kind;
      std::vector<PairResult> results;
      for (; i < list.size() && list[i].kind == kind && results.size() < kItemsALook; ++i)
        results.push_back(list[i].result);
      all.add(kind, std::move(results));
    }
  }
  found = all.take(budget);
}

// Says whether a pair is a candidate of the whole step, as an active set has it.
bool is_contact_candidate(const void* setup, PairKind kind, IdPair pair) {
  return is_candidate(*static_cast<const StepSetup*>(setup)->whole, kind, pair);
}

}  // namespace

// A contact is held as what was found of it, twice while it is put in order, and as a row of the set.
constexpr std::int64_t kBytesAContact = 256;
static_assert(2 * sizeof(FoundPair) <= kBytesAContact &&
              sizeof(FoundPair) + sizeof(Contact) <= kBytesAContact);

std::size_t most_contacts(const Options& options) {
  return std::size_t(options.memory_limit / kBytesAContact);
}

TraversalResult find_contacts(const Mesh& mesh, StepSetup& setup, const Options& options, Collect collect,
                              Budget& budget, Stats& stats, const PairPredicate* only) {
  if (!setup.broad) return {};
  const double begun = setup.clock.seconds();
  const TraversalBounds limited = collect == Collect::all ? bounds(options) : TraversalBounds{};
  NarrowPhaseInput input = narrow_phase_input(mesh, setup, options, collect, limited);
  input.for_many = mesh.data().whole ? mesh.data().whole->rounds_all
                                     : rounds_all(mesh.data().filter->static_ids.size(), mesh.num_vertices());
  const PairPredicate contacts{&setup, is_contact_candidate};
  if (collect == Collect::first) {
    input.stored = true;
    input.rounding = setup.rounding;
    input.contacts = &contacts;
  }
  PlaneContacts planes = find_plane_contacts(
      {mesh.data(), setup.motion, options, {collect == Collect::first, 0, options.touching_may_pass_through}},
      collect, budget, limited.most);
  TraversalResult traversal;
  if (collect == Collect::any && planes.limits.contact) {
    traversal.limits = planes.limits;
    return traversal;
  }
  const NarrowPhase narrow(input);
  const bool shrinks = collect == Collect::first || (collect == Collect::all && options.window < 1);
  Limits sampled;
  const double known = shrinks ? t_max_of(planes, options) : INFINITY;
  Shrunk shrunk;
  if (shrinks) shrunk = shrink_to_t_max(mesh, setup, narrow, options, collect, known, budget, sampled);
  TraversalBounds limits = limited;
  limits.only = only;
  if (shrunk.boxes) limits.whole = &*setup.tree;
  if (collect == Collect::any) limits.whole = &*setup.whole;
  traversal = traverse_pairs(*setup.broad, narrow, collect, shrunk.t_max, budget, 1, limits);
  if (collect == Collect::first) traversal.limits.add(sampled);
  if (collect == Collect::all && !mesh.data().whole)
    sharpen(narrow, least_toi_hi(traversal.found), traversal.found, budget);
  traversal.limits.add(planes.limits);
  add_planes(std::move(planes.found), limited.most, budget, traversal.found);
  copy_counts(traversal, stats);
  add_counts(planes, stats);
  stats.seconds_narrow = setup.clock.seconds() - begun;
  stats.seconds_total = setup.clock.seconds();
  return traversal;
}

double least_toi_hi(const std::vector<FoundPair>& found) {
  double least = INFINITY;
  for (const FoundPair& f : found)
    if (f.kind != PairKind::vertex_plane && f.result.outcome != PairOutcome::initial_separating)
      least = std::min(least, f.result.toi_hi);
  return least;
}

void sharpen_earliest(const Mesh& mesh, const StepSetup& setup, const Options& options, double latest,
                      std::vector<FoundPair>& found, Budget& budget) {
  sharpen(NarrowPhase(narrow_phase_input(mesh, setup, options, Collect::all, bounds(options))), latest, found,
          budget);
}

StepResult step_of_motion(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1,
                          const Options& options, Collect collect, Budget& budget) {
  StepResult r;
  const StepSetup::Use use =
      collect == Collect::first ? StepSetup::Use::stored_step : StepSetup::Use::contacts;
  const Looks looks = collect == Collect::first ? Looks::at_earliest : Looks::at_any;
  StepSetup setup(mesh, x_t0, x_t1, options, use, r.stats, budget, 0, looks);
  r.outcome = setup.motion.status;
  r.vertex = setup.motion.bad_vertex;
  if (r.outcome != Outcome::free) return r;
  const TraversalResult traversal = find_contacts(mesh, setup, options, collect, budget, r.stats);
  limit_step(mesh, traversal, budget, 1, 1, r);
  r.rounding = reported_rounding(setup.rounding);
  r.stats.seconds_total = setup.clock.seconds();
  return r;
}

}  // namespace onset
