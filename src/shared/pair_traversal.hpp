// One traversal of pairs: a source streams batches into the narrow phase, and what that finds is collected.
#pragma once

#include <atomic>
#include <limits>
#include <mutex>
#include <optional>
#include <vector>

#include "broadphase/broad_phase.hpp"
#include "narrowphase/narrow_phase.hpp"
#include "onset/export.hpp"
#include "onset/mesh.hpp"
#include "onset/step_size.hpp"
#include "scene/motion/storing.hpp"
#include "scene/pair_source.hpp"
#include "src/shared/budget.hpp"
#include "src/shared/checked_options.hpp"
#include "src/shared/found_pairs.hpp"

namespace onset {

// Orders by (step_limit, kind, a, b).
bool limits_before(const FoundPair& x, const FoundPair& y);

// What pairs say about a step, whatever the order in which they are added.
struct Limits {
  // The first by limits_before, with a step_limit of at most 1.
  std::optional<FoundPair> contact;
  // The first by (stored_limit, step_limit, kind, a, b), with a stored_limit of at most 1.
  std::optional<FoundPair> stored;
  // The one with the latest clear_from > 0, of several the first by `before`.
  std::optional<FoundPair> clear;
  ONSET_API void add(const FoundPair& found);
  ONSET_API void add(const Limits& other);
};

// What a traversal collects:
// - all: every pair that is not free.
// - first: only the limits; pairs certified beyond the first contact so far are dropped on the way.
// - any: as first, but it ends at the first contact found.
enum class Collect { all, first, any };

struct TraversalResult {
  // With Collect::all, sorted by `before`; no more than TraversalBounds::most. Where time or the caller ended
  // the call, some of those found until then.
  std::vector<FoundPair> found;
  // With Collect::first and any.
  Limits limits;
  NarrowPhaseStats vertex_face, edge_edge, vertex_edge;
  const NarrowPhaseStats& of(PairKind kind) const {
    return kind == PairKind::vertex_face ? vertex_face
           : kind == PairKind::edge_edge ? edge_edge
                                         : vertex_edge;
  }
  NarrowPhaseStats& of(PairKind kind) {
    return const_cast<NarrowPhaseStats&>(static_cast<const TraversalResult&>(*this).of(kind));
  }
};

// What else bounds a traversal.
struct TraversalBounds {
  // With Collect::all, pairs later than the earliest toi + `window`, and than the earliest `most`, may be
  // dropped; the caller cuts off what is left of those beyond the window.
  double window = std::numeric_limits<double>::infinity();
  std::size_t most = std::numeric_limits<std::size_t>::max();
  // If set, only candidates of this are found. A pair within its tolerance and yet apart can be a candidate
  // up to t_max, and not in the whole step.
  const BroadPhaseInput* whole = nullptr;
  // If set, only pairs for which it holds are found.
  const PairPredicate* only = nullptr;
};

// Decides the pairs of every stride-th block. It ends early where the budget is spent: what is found is then
// true, but not all. Pairs certified apart up to `t_max` may be dropped. The culls keep to `t_max` as given,
// advancement to what it shrinks to, so that whether a pair that spends its checks far from contact is
// reported does not depend on the number of threads.
TraversalResult traverse_pairs(const PairSource& pairs, const NarrowPhase& narrow, Collect collect,
                               double t_max, Budget& budget, std::size_t stride = 1,
                               const TraversalBounds& bounds = {});

// Sets up the narrow phase for a step that is to be stored, on which each pair keeps the share `gap_share` of
// its gap. `rounding` is rounding_of_distances(motion).
NarrowPhaseInput stored_step_input(const MeshData& mesh, const Motion& motion, const Accuracy& accuracy,
                                   const Options& options, double gap_share, double rounding);

// Returns the latest time that exact arithmetic may still move the toi of a reported pair to.
inline double latest_time(const PairResult& r) {
  return r.certainty == Certainty::certain ? r.toi_hi : r.toi;
}

// Copies the counts of all kinds of pairs.
void copy_counts(const TraversalResult& traversal, Stats& stats);
// Returns the pair as callers see it, with its vertices.
Pair to_pair(const Mesh& mesh, const FoundPair& found);
// Sets Stats::worst, the pair with the most checks.
void note_worst(const Mesh& mesh, const TraversalResult& traversal, Stats& stats);
// Sets the step in [0, upper], the outcome and the limiting pair by the limits of a traversal up to `t_max`.
// A spent budget makes the step 0.
void limit_step(const Mesh& mesh, const TraversalResult& traversal, const Budget& budget, double upper,
                double t_max, StepResult& result);
// Does the same within the budget, but for StepResult::limiting: returns that pair, one of `limits`, or null.
ONSET_API const FoundPair* limit_step(const Limits& limits, double upper, double t_max, StepResult& result);

}  // namespace onset
