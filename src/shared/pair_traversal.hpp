// One traversal of candidate pairs: the broad phase streams batches into the narrow phase, and the results into a
// collector.
#pragma once

#include <atomic>
#include <limits>
#include <mutex>
#include <optional>
#include <vector>

#include "broadphase/broad_phase.hpp"
#include "narrowphase/narrow_phase.hpp"
#include "onset/mesh.hpp"
#include "onset/step_size.hpp"
#include "scene/motion/storing.hpp"
#include "scene/pair_source.hpp"
#include "src/shared/budget.hpp"
#include "src/shared/checked_options.hpp"

namespace onset {

struct FoundPair {
  PairKind kind;
  PairResult result;
};

// Ordered by (kind, a, b): the order of the active set.
bool before(const FoundPair& x, const FoundPair& y);
// Ordered by (step_limit, kind, a, b).
bool limits_before(const FoundPair& x, const FoundPair& y);

// What the pairs found say about a step, in no order of theirs.
struct Limits {
  std::optional<FoundPair> contact;  // the first in the order of limits_before, at 1 at the latest
  std::optional<FoundPair> stored;   // the first by (stored_limit, step_limit, kind, a, b), at 1 at the latest
  std::optional<FoundPair> clear;    // the one with the last clear_from > 0, of these the first
  void add(const FoundPair& found);
  void add(const Limits& other);
};

// What a traversal collects. all: every pair that is not free. first: the limits only, and pairs certified beyond the first contact
// so far are dropped on the way. any: as first, and the traversal ends at the first contact.
enum class Collect { all, first, any };

struct TraversalResult {
  std::vector<FoundPair> found;  // all: sorted by `before`
  Limits limits;                 // first, any
  NarrowPhaseStats vertex_face, edge_edge;
};

// What else bounds a traversal. `window` and `most` are for those that collect all: pairs later than the earliest toi +
// `window`, and than the earliest `most`, may be dropped on the way (the caller cuts off the rest).
struct TraversalBounds {
  double window = std::numeric_limits<double>::infinity();
  std::size_t most = std::numeric_limits<std::size_t>::max();
  // Only pairs that are candidates of this as well are found: what is within the tolerance and yet apart may be a
  // candidate up to t_max, and not in the whole step.
  const BroadPhaseInput* whole = nullptr;
};

// `t_max`: pairs certified apart beyond it may be dropped. The culls keep to it, advancement to what it shrinks to: a pair that
// spends its checks far from contact is then reported, or not, for any number of threads. `stride`: only every stride-th block of pairs is
// looked at. Ends early where the budget is spent: what is found is then true, but not all.
TraversalResult traverse_pairs(const PairSource& pairs, const NarrowPhase& narrow, Collect collect, double t_max,
                    Budget& budget, std::size_t stride = 1, const TraversalBounds& bounds = {});

// For steps that are stored, of pairs that each keep the share `gap_share` of their gap. rounding: rounding_of_distances(motion).
NarrowPhaseInput stored_step_input(const MeshData& mesh, const Motion& motion, const Accuracy& accuracy,
                                   const Options& options, double gap_share, double rounding);

// When a pair that is reported has surely touched, as far as is known: exact times may move a toi up to there.
inline double latest_time(const PairResult& r) { return r.certainty == Certainty::certain ? r.toi_hi : r.toi; }

// Ordered by (toi, kind, a, b).
bool earlier(const FoundPair& x, const FoundPair& y);

void copy_counts(const TraversalResult& traversal, Stats& stats);
Pair to_pair(const Mesh& mesh, const FoundPair& found);
void note_worst(const Mesh& mesh, const TraversalResult& traversal, Stats& stats);
// The step in [0, upper], outcome and limiting pair that follow from a traversal up to `t_max` that kept the limits: none with a spent
// budget.
void limit_step(const Mesh& mesh, const TraversalResult& traversal, const Budget& budget, double upper, double t_max,
                StepResult& result);

}  // namespace onset
