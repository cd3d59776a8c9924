// Positions rounded to single precision about the middle of the scene, for the culls.
#pragma once

#include <array>
#include <vector>

#include "base/aligned.hpp"
#include "onset/export.hpp"
#include "scene/motion/motion.hpp"

namespace onset {

// A row is x y z error at t = 0 and x y z 0 at t = 1, scaled. `error` bounds the Euclidean distance of either
// point from the true one; it is infinite for a point too far out.
inline constexpr int kFloatStride = 8;

// One vertex in so many is in the sample whose median is the middle of a scene.
inline int stride_of_middle(int vertices) { return vertices < 126 ? 1 : vertices / 63; }
// Returns the median of the starts of these, which it takes.
ONSET_API std::array<double, 3> middle_of(std::vector<std::array<double, 3>> starts);

// Rounds all positions about `middle`, or that of this motion where it is null; `scale` is a power of two.
AlignedArray<float> round_positions(const Motion& motion, double scale,
                                    const std::array<double, 3>* middle = nullptr);

}  // namespace onset
