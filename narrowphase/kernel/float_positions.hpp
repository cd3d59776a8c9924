// Positions rounded to single precision about the middle of the scene, for the culls.
#pragma once

#include "base/aligned.hpp"
#include "scene/motion/motion.hpp"

namespace onset {

// A row is x y z error at t = 0 and x y z 0 at t = 1, scaled. `error` bounds the Euclidean distance of either
// point from the true one; it is infinite for a point too far out.
inline constexpr int kFloatStride = 8;

// Rounds all positions; `scale` is a power of two.
AlignedArray<float> round_positions(const Motion& motion, double scale);

}  // namespace onset
