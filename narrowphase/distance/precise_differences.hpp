// A pair's differences in double-doubles, in units of a power of two: from positions, and at a time of a
// motion.
#pragma once

#include "narrowphase/distance/nearest.hpp"

namespace onset {

// x: the four points of a pair, three coordinates each.
double largest_corner_component(PairKind kind, const double* const (&x)[4]);

// The power of two that brings the largest component of a corner difference into [1, 2) (subnormal ones into
// [2^-53, 2)); 1 where all are 0.
double inverse_unit(double largest);

// Times `scale`, one rounding each.
Differences<double> rounded_differences(PairKind kind, const double* const (&x)[4], double scale);

// Times `scale`, without error, but for what 2^-1074 is too coarse for; corners by 3u^2 of their size.
Differences<DoubleDouble> precise_differences(PairKind kind, const double* const (&x)[4], double scale);

// A pair's motion, scaled so that the largest component of a corner difference at both ends is in [1, 2).
struct PreciseMotion {
  double unit = 1;                         // model length
  double size = 0;                         // a little above the largest corner difference at both ends
  Differences<DoubleDouble> start, end{};  // none has corners where size is 0

  PreciseMotion(PairKind kind, const double* const (&x0)[4], const double* const (&x1)[4]);
  Differences<DoubleDouble> at(double t) const;
  // What these are off by. Mixing q, a and b and taking their sums errs by less than 100 u^2 of the edges at
  // both ends, which are below twice the size.
  double blur(double t) const { return t == 0 ? 0 : 0x1p-97 * size; }
};

}  // namespace onset
