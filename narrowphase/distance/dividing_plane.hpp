// Planes that keep the two primitives of a pair apart while each of their vertices moves at its own pace
// (docs/per-vertex-steps.md).
#pragma once

#include "onset/result.hpp"

namespace onset {

// Heights are normal.(x - origin) scale. A vertex of the first primitive is on its side from the height
// `first` on, one of the second up to `second`.
struct DividingPlane {
  double normal[3], origin[3];
  // A power of two.
  double scale;
  double first, second;
};

// Certified bounds of a height.
struct Height {
  double lower, upper;
};
// In doubles, and in double-doubles.
Height quick_height(const DividingPlane& plane, const double* x);
Height precise_height(const DividingPlane& plane, const double* x);

// Returns more than the height of x0 + s (x1 - x0), s in [0, 1], can change when its coordinates are rounded
// to doubles (scene/motion/storing.hpp).
double rounding_of_height(const DividingPlane& plane, const double* x0, const double* x1);

// Says whether a point, stored as it is, is on its side. Certain where it says yes.
bool on_side(const DividingPlane& plane, bool first, const double* x);

// How a plane is to lie.
struct Demand {
  // What the pair has to keep, rounded up, in model length and in the norm in use.
  double separation;
  bool maximum_norm;
  // Of the gap beyond the separation, in [0, 1).
  double gap_share;
};

enum class Division {
  // No pace of the vertices brings the pair together, nor does storing.
  free,
  // The plane says how far each vertex may go. Where the pair starts within its separation, both primitives
  // keep the heights that they have.
  divided,
  // No plane was found that certainly has the start on both sides.
  none,
};

// Finds a plane for the motion from x0 to x1 (the pair's four points each, finite and within kMaxCoordinate)
// that lets both primitives move by as much of what they approach it as the gap allows, in proportion to
// that.
Division divide(PairKind kind, const double* const (&x0)[4], const double* const (&x1)[4],
                const Demand& demand, DividingPlane& plane);

}  // namespace onset
