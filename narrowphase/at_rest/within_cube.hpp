// Whether a pair at rest is within a distance in the maximum norm.
#pragma once

#include "onset/result.hpp"

namespace onset {

// Returns false where the L-infinity distance is certainly beyond d; true else, by rounding up to about 2^-44
// of the pair's size beyond d. x: the four points of the pair, finite, within kMaxCoordinate.
bool within_cube(PairKind kind, const double* const (&x)[4], double d);

}  // namespace onset
