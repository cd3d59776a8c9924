// Positions rounded to single precision about the middle of the scene, for culls that can do with that.
#pragma once

#include "base/aligned.hpp"
#include "scene/motion/motion.hpp"

namespace onset {

// Eight floats a vertex: x y z error at t = 0, x y z 0 at t = 1, scaled. `error` bounds the Euclidean
// distance of either stored point from the true one, infinite where that is too far out.
inline constexpr int kFloatStride = 8;

// `scale`: a power of two.
AlignedArray<float> round_positions(const Motion& motion, double scale);

}  // namespace onset
