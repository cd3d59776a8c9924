// Which linear primitives can be met by anything that turns during a step.
#pragma once

#include <array>
#include <vector>

#include "scene/motion/motion.hpp"
#include "src/trajectory/turning_scene.hpp"

namespace onset {

// Returns, by kind, those of scene.others whose swept boxes come within `gap` of a box around all that turns.
//
// motion: the chords of the whole step of the vertices that turn, which stray from them by no more than
// `strays`. x0, x1: the ends of the others, 3 #V.
std::array<std::vector<int>, 3> within_reach(const TurningScene& scene, const Motion& motion,
                                             const std::vector<double>& x0, const std::vector<double>& x1,
                                             double strays, double gap);

}  // namespace onset
