// How a coordinate is widened: for rounding at t_max, and by an inflation.
#pragma once

#include <algorithm>
#include <cmath>

namespace onset {

struct Interval {
  double lo, hi;
};

// Contains x_t0 + h (x_t1 - x_t0). (1-h) x_t0 + h x_t1 takes three roundings a term at most: 3 u max|x|, plus
// one more when the bound is applied; 8 u = 2^-50 covers them with the second-order terms, 2^-1070 the
// underflow of the products. The exact point lies between the ends, so clamping to them keeps it (and makes
// vertices at rest exact).
inline Interval at_t_max(double x_t0, double x_t1, double h) {
  if (h == 1) return {x_t1, x_t1};
  const double x = (1 - h) * x_t0 + h * x_t1;
  const double error = std::max(std::fabs(x_t0), std::fabs(x_t1)) * 0x1p-50 + 0x1p-1070;
  return {std::max(x - error, std::min(x_t0, x_t1)), std::min(x + error, std::max(x_t0, x_t1))};
}

// A sum s = fl(x + r) is off by half a unit in the last place at most, which is < |s| 2^-52; sums do not
// underflow. Monotone in x, so that widening commutes with taking the least or largest coordinate.
inline double widen_down(double x, double r) { return r > 0 ? (x - r) - std::fabs(x - r) * 0x1p-52 : x; }
inline double widen_up(double x, double r) { return r > 0 ? (x + r) + std::fabs(x + r) * 0x1p-52 : x; }

}  // namespace onset
