// One pass of the pipeline: the broad phase streams batches into the narrow phase, and the results into a
// collector.
#pragma once

#include <atomic>
#include <limits>
#include <mutex>
#include <vector>

#include "broadphase/broad_phase.hpp"
#include "narrowphase/narrow_phase.hpp"
#include "onset/mesh.hpp"
#include "src/budget.hpp"

namespace onset {

struct FoundPair {
  PairKind kind;
  PairResult result;
};

// Ordered by (kind, a, b): the order of the active set.
bool before(const FoundPair& x, const FoundPair& y);
// Ordered by (step_limit, kind, a, b): the order of limiting pairs.
bool limits_before(const FoundPair& x, const FoundPair& y);

// What a pass keeps. all: every pair that is not free. limiting: the first in the order of limits_before
// only, and pairs certified beyond the best so far are dropped on the way. any: as limiting, and the pass
// ends early.
enum class Keep { all, limiting, any };

struct PassResult {
  std::vector<FoundPair> found;  // all: sorted by `before`; else at most one
  NarrowPhaseStats vertex_face, edge_edge;
};

// What else bounds a pass. `window` and `most` are for passes that keep all: pairs later than the earliest toi +
// `window`, and than the earliest `most`, may be dropped on the way (the caller cuts off the rest).
struct PassBounds {
  double window = std::numeric_limits<double>::infinity();
  std::size_t most = std::numeric_limits<std::size_t>::max();
  // Only pairs that are candidates of this as well are found: what is within the tolerance and yet apart may be a
  // candidate up to a horizon, and not in the whole step.
  const BroadPhaseInput* whole = nullptr;
};

// `horizon`: pairs certified apart beyond it may be dropped. `stride`: only every stride-th block of pairs is
// looked at. Ends early where the budget is spent: what is found is then true, but not all.
PassResult run_pass(const PairSource& pairs, const NarrowPhase& narrow, Keep keep, double horizon,
                    Budget& budget, std::size_t stride = 1, const PassBounds& bounds = {});

// When a pair that is reported has surely touched, as far as is known: exact times may move a toi up to there.
inline double latest_time(const PairResult& r) { return r.certainty == Certainty::certain ? r.toi_hi : r.toi; }

// Ordered by (toi, kind, a, b).
bool earlier(const FoundPair& x, const FoundPair& y);

void copy_counts(const PassResult& pass, Stats& stats);
Pair to_pair(const Mesh& mesh, const FoundPair& found);
void note_worst(const Mesh& mesh, const PassResult& pass, Stats& stats);
// The step, outcome and limiting pair that follow from a pass that kept the limiting pair: none with a spent
// budget.
void limit_step(const Mesh& mesh, const PassResult& pass, const Budget& budget, StepResult& result);

}  // namespace onset
