// Points of doubles as exact vectors.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <onset/query.hpp>

#include "tests/oracle/arithmetic/geometry.hpp"
#include "tests/oracle/arithmetic/rational.hpp"
#include "tests/queries/query.hpp"

namespace onset::oracle {

using ExactPoints = std::array<Vector<Rational>, 4>;

// The exponent of the last bit of x; large for zero.
inline int last_bit(double x) {
  if (x == 0) return std::numeric_limits<int>::max();
  int exponent;
  double fraction = std::frexp(x, &exponent);
  while (fraction != std::floor(fraction)) fraction *= 2, --exponent;
  return exponent;
}

inline Rational power_of_two(int exponent) {
  const Rational magnitude(boost::multiprecision::cpp_int(1) << unsigned(std::abs(exponent)));
  return exponent < 0 ? Rational(1 / magnitude) : magnitude;
}

// What makes all coordinates, and `length` too, integers: no denominators to reduce.
inline Rational unit_scale(const scenes::Query& query, double length = 0) {
  int last = last_bit(length);
  for (const auto* points : {&query.t0, &query.t1})
    for (const Point& p : *points)
      for (double x : p) last = std::min(last, last_bit(x));
  return power_of_two(last == std::numeric_limits<int>::max() ? 0 : -last);
}

inline ExactPoints exact(const std::array<Point, 4>& points, const Rational& scale) {
  ExactPoints x;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 3; ++k) x[i][k] = Rational(points[i][k]) * scale;
  return x;
}

}  // namespace onset::oracle
