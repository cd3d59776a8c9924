// The direction that separates a pair best in the maximum norm, however thin the pair is.
#pragma once

#include "narrowphase/distance/precise_differences.hpp"

namespace onset {

// Returns w of Euclidean length 1; 0 where all corners are 0. The distance is min_k w.c_k / |w|_1 but for the
// rounding of w, a few u of the largest corner.
Vec best_direction_in_maximum_norm(const Differences<DoubleDouble>& d);

// Returns a number at most the distance in the maximum norm, and at least 0: less by a few u of the largest
// corner (docs/theory.md, L44). x: the pair's four points, finite and within kMaxCoordinate.
double distance_below_in_maximum_norm(PairKind kind, const double* const (&x)[4]);

}  // namespace onset
