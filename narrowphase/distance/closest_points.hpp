// The closest points of a pair at one time, the direction that keeps it apart, and certified bounds of its
// distance.
#pragma once

#include "narrowphase/distance/double_double.hpp"
#include "narrowphase/distance/nearest.hpp"

namespace onset {

// Lengths are model lengths; u = 2^-53, rho is the largest corner difference first - second of the pair (at
// the time). All that is said of errors holds up to 2^-1073 in addition, the spacing of the smallest doubles.
struct ClosestPoints {
  // Signed, as in ClosePair: feasible multiples of 2^-52, those of the first primitive sum to exactly 1,
  // those of the second to exactly -1: the difference of the points does not depend on where in space the
  // pair is. Exactly 0 for corners that take no part.
  double weights[4];
  double distance;  // of the points that the weights stand for: within 48 u rho of the exact distance of the
                    // pair
  // Certified: 0 <= lower <= exact distance <= upper, upper - lower <= 64 u rho, and lower > 0 wherever the
  // pair is apart by more than 2^-47 rho; unless features tie it is so down to 2^-90 rho.
  double lower, upper;
  // From the second primitive towards the first, of unit length up to 8u; where the pair touches, 0 or any
  // that does. Its least product with a corner difference, which bounds the distance as long as the direction
  // is held, is no less than lower - 16 u rho.
  double direction[3];
  // The closest points are inside both primitives, or on the boundary, and the direction is square to both
  // edges or the face; false: it is square to an edge that holds one of them, or leads from vertex to vertex.
  bool square;
};

// x: the four points of the pair, three coordinates each (finite, within kMaxCoordinate).
ClosestPoints closest_points(PairKind kind, const double* const (&x)[4]);

// The same at time t in [0, 1] of the exact motion from x0 to x1; rho is the largest corner difference at
// both ends, where the one at t is less than 2^-40 of that.
ClosestPoints closest_points(PairKind kind, const double* const (&x0)[4], const double* const (&x1)[4],
                             double t);

// The same of differences that are one rounding and `blur` off; false where doubles do not tell, or the pair
// may touch. All bounds grow by 8 blur. Lengths are in the differences' unit.
bool quick_closest_points(const Differences<double>& d, double blur, ClosestPoints& r);

// The same in double-doubles throughout, of differences that are off by `blur` at most: the direction is that
// of the exact closest points within u + 2^-96 rho^2 / distance^2. Lengths are in the differences' unit; none
// is beyond 2^10.
ClosestPoints precise_closest_points(const Differences<DoubleDouble>& d, double blur);

}  // namespace onset
