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
  // Of unit length, separates the pair best at a time.
  const std::function<Vec(double)>& direction;
  // Null: the pair may touch as it parts.
  const ExactPair* exact;
};

// Until `t` the pair comes no closer than 184u rho below its distance at t = 0, or 120u rho below the
// certified lower bound of that (Euclidean norm; the maximum norm can lose 70u rho a round, docs/theory.md,
// (17.1)). apart: at t it is beyond d by `excess`, and advancement can go on from there.
struct Parting {
  double t = 0;
  bool apart = false;
  double excess = 0;
};

// Along the closest direction the least product with a corner is a concave function of time and a lower bound
// of the distance: where it is no less later than at the start, it was no less between. Where this is noise,
// a direction n that has the whole pair on its positive side, at 0 up to rounding and strictly at t, keeps it
// there in between; the side is decided exactly, and so is that the pair does not touch before t. Motion that
// stays in touch is pressing, unless nothing moves.
Parting find_parting(const InitialCase& c);

}  // namespace onset
