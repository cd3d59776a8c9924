// One pass of the pipeline: the broad phase streams batches into the narrow phase, and the results into a
// collector.
#pragma once

#include <atomic>
#include <mutex>
#include <vector>

#include "broadphase/broad_phase.hpp"
#include "narrowphase/narrow_phase.hpp"
#include "onset/mesh.hpp"

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

// `horizon`: pairs certified apart beyond it may be dropped. `stride`: only every stride-th block of pairs is
// looked at.
PassResult run_pass(const PairSource& pairs, const NarrowPhase& narrow, Keep keep, double horizon,
                    std::size_t stride = 1);

void copy_counts(const PassResult& pass, Stats& stats);
Pair to_pair(const Mesh& mesh, const FoundPair& found);
// The step, outcome and limiting pair that follow from a pass that kept the limiting pair.
void limit_step(const Mesh& mesh, const PassResult& pass, StepResult& result);

}  // namespace onset
