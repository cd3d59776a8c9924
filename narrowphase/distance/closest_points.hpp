// The closest points of a pair at one time, the direction that keeps it apart, and certified bounds of its
// distance.
#pragma once

#include "narrowphase/distance/double_double.hpp"
#include "narrowphase/distance/nearest.hpp"

namespace onset {

// Model lengths; rho is the largest corner difference at the time. The smallest doubles add 2^-1073 to all
// errors.
struct ClosestPoints {
  // Signed, as in ClosePair: feasible multiples of 2^-52, of which those of the first primitive sum to 1,
  // those of the second to -1. They are 0 for corners that take no part.
  double weights[4];
  // Of the points that the weights stand for: within 48 u rho of the exact distance.
  double distance;
  // Certified: 0 <= lower <= exact distance <= upper and upper - lower <= 64 u rho. lower > 0 where the pair
  // is apart by more than 2^-47 rho; unless features tie, by more than 2^-90 rho (docs/theory.md, T8).
  double lower, upper;
  // From the second primitive towards the first, of unit length up to 8u; where the pair touches, 0 or any
  // that does. Its least product with a corner difference is at least lower - 4.5 u rho.
  double direction[3];
  // Whether the direction is square to both edges or the face; else it is square to an edge that holds one of
  // the points, or leads from vertex to vertex.
  bool square;
};

// Finds them for the pair's four points x, finite and within kMaxCoordinate.
ClosestPoints closest_points(PairKind kind, const double* const (&x)[4]);

// Finds them at time t in [0, 1] of the exact motion from x0 to x1; rho is the largest corner difference at
// both ends, where that at t is less than 2^-40 of it.
ClosestPoints closest_points(PairKind kind, const double* const (&x0)[4], const double* const (&x1)[4],
                             double t);

// Finds them for differences that are one rounding and `blur` off, in their unit; all bounds grow by 8 blur.
// Returns false where doubles do not tell, or the pair may touch.
bool quick_closest_points(const Differences<double>& d, double blur, ClosestPoints& r);

// Finds them in double-doubles for differences that are off by `blur` at most, in their unit and below 2^10:
// the direction is exact within u + 2^-96 rho^2 / distance^2.
ClosestPoints precise_closest_points(const Differences<DoubleDouble>& d, double blur);

}  // namespace onset
