// Closest points of a pair at one time, the direction that keeps it apart, and certified bounds of its
// distance.
#pragma once

#include "narrowphase/distance/double_double.hpp"
#include "narrowphase/distance/nearest.hpp"

namespace onset {

// Model lengths; rho is the largest corner difference at the time, and 2^-1073 adds to all errors.
struct ClosestPoints {
  // Feasible multiples of 2^-52, signed as in ClosePair: the first primitive's sum to 1, the second's to -1.
  // They are 0 for corners that take no part.
  double weights[4];
  // The distance of the weights' points, within 48 u rho of the exact one.
  double distance;
  // 0 <= lower <= exact distance <= upper <= lower + 64 u rho, and lower > 0 where the pair is apart by more
  // than 2^-47 rho, or 2^-90 rho where no features tie (docs/theory.md, T8).
  double lower, upper;
  // From the second primitive towards the first, of unit length up to 8u; 0 or any where the pair touches.
  // Its least product with a corner difference is at least lower - 4.5 u rho.
  double direction[3];
  // The direction of the closest points themselves, which is another one where a corner and a side tie.
  double normal[3];
  // Whether the direction is square to both edges or the face; else only to an edge, or to nothing.
  bool square;
};

// x: the pair's four points, finite and within kMaxCoordinate.
ClosestPoints closest_points(PairKind kind, const double* const (&x)[4]);

// Finds them at time t of the exact motion from x0 to x1; rho is that of both ends where the one at t is less
// than 2^-40 of it.
ClosestPoints closest_points(PairKind kind, const double* const (&x0)[4], const double* const (&x1)[4],
                             double t);

// Finds them in doubles, in the unit of the differences, which are one rounding and `blur` off: bounds grow
// by 8 blur. Returns false where doubles do not tell, or the pair may touch.
bool quick_closest_points(const Differences<double>& d, double blur, ClosestPoints& r);

// Finds them in double-doubles, in the unit of the differences, which are below 2^10 and off by `blur` at
// most; the direction is right within u + 2^-96 rho^2 / distance^2.
ClosestPoints precise_closest_points(const Differences<DoubleDouble>& d, double blur);

}  // namespace onset
