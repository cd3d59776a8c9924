// The step of pairs that are known: no broad phase.
#pragma once

#include "onset/mesh.hpp"
#include "onset/step_size.hpp"
#include "scene/motion/motion.hpp"
#include "src/shared/pair_list.hpp"

namespace onset {

// The largest step of these pairs, in [0, upper], each keeping the share `gap_share` of its gap, stored in doubles, and the statistics. A motion
// that cannot be used is an outcome.
StepResult step_of_pairs(const Mesh& mesh, const Motion& motion, const PairList& pairs, const Options& options,
                   double gap_share, Budget& budget, double upper = 1);

}  // namespace onset
