// What storing positions in doubles can change.
#pragma once

#include "scene/motion/motion.hpp"

namespace onset {

// Storing x_t0 + s (x_t1 - x_t0) in doubles errs by at most 5u M + 3 eta a coordinate, M the largest one at both ends and eta
// 2^-1074, whatever the order of operations:
// - x0 + s (x1 - x0): |x1 - x0| <= 2M rounds by 2u M, its product with s by 2u M, the sum by u M;
// - with that product and sum fused, or x1 = x0 + dx rounded (u M) and then x0 + s dx (3u M), by less;
// - (1 - s) x0 + s x1: u for 1 - s, u for each product, u for the sum, weights that sum to 1: 3u M.
// Each product underflows by eta / 2 at most. A point of a primitive moves by no more than its vertices, the distance of two points by
// sqrt(3) times twice that: 10 sqrt(3) u M = 17.4u M; 18.5u covers second order. For the maximum norm it is less.
inline constexpr double kStoring = 18.5 * 0x1p-53;

// Model length: that bound of the change of a distance, for all pairs.
double rounding_of_distances(const Motion& m);

// What StepResult::rounding says: twice this is more than twice that bound and what a look at a start cannot tell, 100u of a pair's
// rho, which is below 3.5 M.
inline double reported_rounding(double rounding_of_distances) { return rounding_of_distances * 11; }

}  // namespace onset
