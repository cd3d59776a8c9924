// The closest points of a pair at rest, and a certified lower bound of its distance.
#pragma once

#include "onset/result.hpp"

namespace onset {

struct ClosestPoints {
  double weights[4];  // signed, as in ClosePair
  double distance;    // of the points the weights stand for
  double lower;       // <= the exact distance of the pair; may be negative
  double upper;
  double direction[3];
};

// x: the four points of the pair, three coordinates each (model length, finite, within kMaxCoordinate).
ClosestPoints closest_points(PairKind kind, const double* const (&x)[4]);

}  // namespace onset
