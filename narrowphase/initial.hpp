// Pairs that touch, or are closer than the separation, at t = 0: does the motion part them (docs/theory.md,
// §17.1)?
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
  double separation;  // d, scaled as the corners
  // Returns the unit direction that separates the pair best at a time.
  const std::function<Vec(double)>& direction;
  // Null: the pair may touch as it parts.
  const ExactPair* exact;
};

// Until `t` the pair comes no closer than 184u rho below its distance at t = 0, or 120u rho below the
// certified lower bound of that (Euclidean norm; the maximum norm can lose 70u rho a round; docs/theory.md,
// (17.1)). apart: at t it is beyond d by `excess`, so advancement can go on from there.
struct Parting {
  double t = 0;
  bool apart = false;
  double excess = 0;
};

// Decides whether the motion parts the pair. Along the closest direction the least product with a corner is
// concave in time and a lower bound of the distance: where it is no less later, it was no less in between.
// Where it is noise, a direction must have the whole pair on its positive side, at 0 up to rounding and
// strictly at t; the side, and that the pair does not touch before t, are decided exactly. Motion that stays
// in touch is pressing, unless nothing moves.
Parting find_parting(const InitialCase& c);

// Of a pair within noise of touching at the start: whether it is plain, without a search, that nothing parts
// it. find_parting asks this first.
bool plainly_goes_through(const InitialCase& c);

}  // namespace onset
