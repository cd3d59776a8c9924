// Outward rounding of a coordinate at t_max, and of one that is widened.
#pragma once

#include <algorithm>
#include <cmath>

namespace onset {

struct Interval {
  double lo, hi;
};

// Returns an interval that contains x_t0 + h (x_t1 - x_t0): 2^-50 max|x| + 2^-1070 cover all roundings
// (docs/theory.md, L27). Clamping to the ends keeps the exact point, and makes vertices at rest exact.
inline Interval at_t_max(double x_t0, double x_t1, double h) {
  if (h == 1) return {x_t1, x_t1};
  const double x = (1 - h) * x_t0 + h * x_t1;
  const double error = std::max(std::fabs(x_t0), std::fabs(x_t1)) * 0x1p-50 + 0x1p-1070;
  return {std::max(x - error, std::min(x_t0, x_t1)), std::min(x + error, std::max(x_t0, x_t1))};
}

// Return bounds of x - r and x + r (docs/theory.md, L28). They are monotone in x, so that widening commutes
// with taking the smallest or largest coordinate.
inline double widen_down(double x, double r) { return r > 0 ? (x - r) - std::fabs(x - r) * 0x1p-52 : x; }
inline double widen_up(double x, double r) { return r > 0 ? (x + r) + std::fabs(x + r) * 0x1p-52 : x; }

}  // namespace onset
