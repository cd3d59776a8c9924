// The quantities of a pair in exact arithmetic, in the kernels' terms.
#pragma once

#include "tests/oracle/arithmetic/geometry.hpp"
#include "tests/oracle/arithmetic/rational.hpp"
#include "tests/queries/query.hpp"

namespace onset::tests {

using oracle::cross;
using oracle::dot;
using oracle::Rational;
using oracle::operator-;
using RationalVector = oracle::Vector<Rational>;

inline RationalVector exact(const double (&p)[3]) { return {Rational(p[0]), Rational(p[1]), Rational(p[2])}; }
inline RationalVector exact(const Point& p) { return {Rational(p[0]), Rational(p[1]), Rational(p[2])}; }
inline RationalVector plus(const RationalVector& a, const RationalVector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
template <class T>
T between(const T& a, const T& b, const Rational& t) {
  if constexpr (std::is_same_v<T, Rational>)
    return a + t * (b - a);
  else
    return plus(a, oracle::scaled<Rational>(t, b - a));
}

// Corners p - v_j or a_i - b_j and the two spanning edges at both ends, divided by `unit`.
struct ExactPair {
  int corners;
  RationalVector c[2][4], e[2][2];

  ExactPair(const scenes::Query& query, double unit) : corners(query.kind == PairKind::edge_edge ? 4 : 3) {
    const Rational scale = Rational(1) / Rational(unit);
    for (int end = 0; end < 2; ++end) {
      const auto& points = end == 0 ? query.t0 : query.t1;
      RationalVector x[4];
      for (int i = 0; i < 4; ++i) x[i] = oracle::scaled<Rational>(scale, exact(points[i]));
      const bool ee = corners == 4;
      for (int k = 0; k < corners; ++k) c[end][k] = ee ? x[k / 2] - x[2 + k % 2] : x[0] - x[1 + k];
      e[end][0] = ee ? x[1] - x[0] : x[2] - x[1];
      e[end][1] = ee ? x[3] - x[2] : x[3] - x[1];
    }
  }

  RationalVector corner(int k, const Rational& t) const { return between(c[0][k], c[1][k], t); }

  // F(t, u, v) of the paper.
  RationalVector value(const Rational& t, const Rational& u, const Rational& v) const {
    const RationalVector c0 = corner(0, t), c1 = corner(1, t), c2 = corner(2, t);
    if (corners == 4) return between(between(c0, c1, v), between(c2, corner(3, t), v), u);
    return plus(plus(c0, oracle::scaled<Rational>(u, c1 - c0)), oracle::scaled<Rational>(v, c2 - c0));
  }
};

}  // namespace onset::tests
