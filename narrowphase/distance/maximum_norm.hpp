// The direction that separates a pair best in the maximum norm, however thin the pair is.
#pragma once

#include "narrowphase/distance/precise_differences.hpp"

namespace onset {

// Returns w of Euclidean length 1; 0 where all corners are 0. The distance is min_k w.c_k / |w|_1 but for the
// rounding of w, a few u of the largest corner.
Vec best_direction_in_maximum_norm(const Differences<DoubleDouble>& d);

}  // namespace onset
