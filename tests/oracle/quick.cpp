#include "tests/oracle/quick.hpp"

#include <algorithm>
#include <cmath>

#include "tests/oracle/arithmetic/exact_points.hpp"

namespace onset::oracle {
namespace {

using Vec = Vector<double>;

double largest(const Vec& a, const Vec& b) {
  double m = 0;
  for (std::size_t k = 0; k < 3; ++k) m = std::max({m, std::fabs(a[k]), std::fabs(b[k])});
  return m;
}

double determinant(const Vec& q, const Vec& a, const Vec& b) { return dot(q, cross(a, b)); }

}  // namespace

// A difference of doubles is off by half a unit in its last place.
bool boxes_apart(const scenes::Query& query, double gap) {
  for (std::size_t k = 0; k < 3; ++k) {
    double lo[2] = {INFINITY, INFINITY}, hi[2] = {-INFINITY, -INFINITY};
    for (std::size_t i = 0; i < 4; ++i) {
      const bool second = int(i) >= scenes::first_body(query.kind);
      lo[second] = std::min({lo[second], query.t0[i][k], query.t1[i][k]});
      hi[second] = std::max({hi[second], query.t0[i][k], query.t1[i][k]});
    }
    if (std::max(lo[0] - hi[1], lo[1] - hi[0]) * (1 - 0x1p-50) > gap) return true;
  }
  return false;
}

// The four points are coplanar where f(t) = det(q, a, b) is zero. With Q, A, B the largest components of the
// computed differences at both ends, f's Bernstein coefficients are means of up to three determinants of six
// products <= QAB each; three roundings of differences, four in a determinant, two of the mean and three at
// each of three levels of de Casteljau's algorithm: an error below 6 (3 + 4 + 2 + 9 + 1) u QAB < 2^-46 QAB,
// the 1 for terms of second order. Moving every coordinate by at most m changes differences by 2m and a
// determinant by less than 6 * 3 * 2m D^2, D = max(Q, A, B) + 2m.
bool surely_apart(const scenes::Query& query, double until, double moved) {
  if (boxes_apart(query, 2 * moved)) return true;
  const auto r0 = relative(query.kind, std::array<Vec, 4>(query.t0)),
             r1 = relative(query.kind, std::array<Vec, 4>(query.t1));
  const double q = largest(r0.q, r1.q), a = largest(r0.a, r1.a), b = largest(r0.b, r1.b);
  const double d = std::max({q, a, b}) + 2 * moved;
  if (!(q * a * b > 0x1p-900 && d < 0x1p300)) return false;
  double c[4] = {
      determinant(r0.q, r0.a, r0.b),
      (determinant(r1.q, r0.a, r0.b) + determinant(r0.q, r1.a, r0.b) + determinant(r0.q, r0.a, r1.b)) / 3,
      (determinant(r0.q, r1.a, r1.b) + determinant(r1.q, r0.a, r1.b) + determinant(r1.q, r1.a, r0.b)) / 3,
      determinant(r1.q, r1.a, r1.b)};
  for (int level = 1; until < 1 && level < 4; ++level)
    for (int i = 3; i >= level; --i) c[i] = (1 - until) * c[i - 1] + until * c[i];
  const double bound = 0x1p-46 * q * a * b + 37 * moved * d * d;
  const auto [least, most] = std::minmax_element(c, c + 4);
  return *least > bound || *most < -bound;
}

// The bound is that of a determinant above.
int orientation(PairKind kind, const std::array<Point, 4>& x) {
  const auto r = relative(kind, std::array<Vec, 4>(x));
  const double f = determinant(r.q, r.a, r.b);
  const double bound = 0x1p-46 * largest(r.q, r.q) * largest(r.a, r.a) * largest(r.b, r.b);
  if (bound > 0x1p-900 && std::fabs(f) > bound) return f > 0 ? 1 : -1;
  const auto e = relative(kind, exact(x, 1));
  return sign<Rational>(dot(e.q, cross(e.a, e.b)));
}

}  // namespace onset::oracle
