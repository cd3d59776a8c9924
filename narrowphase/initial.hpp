// Pairs that touch, or are closer than the separation, at t = 0: does the motion press them together or part
// them?
#pragma once

#include <functional>

#include "narrowphase/corners.hpp"
#include "narrowphase/exact/exact.hpp"
#include "narrowphase/kernel/kernel.hpp"
#include "narrowphase/vec.hpp"

namespace onset {

struct InitialCase {
  const Corners& corners;
  const KernelPairs& pairs;
  int row;  // the pair, in `pairs`
  PairKind kind;
  double separation;                            // d, scaled as the corners
  const std::function<Vec(double)>& direction;  // unit, that separates the pair best at a time
  const ExactPair* exact;                       // null: the pair may touch as it parts
};

// Until `t` the pair never comes closer than it is at t = 0, up to the rounding of two products, 10u rho; nothing is
// known after it. apart: at t it is farther apart than d, by `excess`, so advancement can go on from there.
struct Parting {
  double t = 0;
  bool apart = false;
  double excess = 0;
};

// Closer than d but not touching: along the closest direction w the least product with a corner is a concave
// function of time and a lower bound of the distance; where it is no less at some later time than at the start, it was
// no less between. So close that this is noise, or touching: a direction n that has the whole pair on its positive side
// at 0 (up to rounding) and strictly so at t keeps it there in between; the side itself is decided exactly, and so is that
// the pair does not touch before t. Motion that stays in touch is pressing, unless nothing moves at all.
Parting find_parting(const InitialCase& c);

}  // namespace onset
