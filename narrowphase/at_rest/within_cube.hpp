// Whether a pair at rest is within a distance in the maximum norm.
#pragma once

#include "onset/result.hpp"

namespace onset {

// Returns false where the distance is certainly beyond d, true where it is not, or by no more than about
// 2^-44 of the pair's size. x: the pair's four points, finite, within kMaxCoordinate.
bool within_cube(PairKind kind, const double* const (&x)[4], double d);

}  // namespace onset
