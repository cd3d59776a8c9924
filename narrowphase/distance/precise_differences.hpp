// A pair's differences in units of a power of two, from positions and at a time of a motion.
#pragma once

#include "narrowphase/distance/nearest.hpp"

namespace onset {

double largest_corner_component(PairKind kind, const double* const (&x)[4]);

// Returns the power of two that brings `largest` into [1, 2), subnormal ones into [2^-53, 2); 1 for 0.
double inverse_unit(double largest);

// Times `scale`, one rounding each.
Differences<double> rounded_differences(PairKind kind, const double* const (&x)[4], double scale);

// Times `scale`, without error but for underflow; corners err by 3u^2 of their size.
Differences<DoubleDouble> precise_differences(PairKind kind, const double* const (&x)[4], double scale);

// A pair's motion, scaled so that the largest component of a corner at both ends is in [1, 2).
struct PreciseMotion {
  double unit = 1;  // model length
  // A little above the largest corner at both ends; where it is 0, the differences have no corners.
  double size = 0;
  Differences<DoubleDouble> start, end{};

  PreciseMotion(PairKind kind, const double* const (&x0)[4], const double* const (&x1)[4]);
  Differences<DoubleDouble> at(double t) const;
  // Bounds what these are off by; 145 u^2 size is proved (docs/theory.md, L43).
  double blur(double t) const { return t == 0 ? 0 : 0x1p-97 * size; }
};

}  // namespace onset
