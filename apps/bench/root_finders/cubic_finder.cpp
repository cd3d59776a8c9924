#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <vector>

#include "bench/root_finders/finder.hpp"
#include "bench/root_finders/finder_motion.hpp"

namespace app {
namespace {

// c[0] + c[1] t + c[2] t^2 + c[3] t^3
using Cubic = std::array<double, 4>;

double value(const Cubic& c, double t) { return c[0] + t * (c[1] + t * (c[2] + t * c[3])); }

// (a x b) . q with a, b, q linear in t.
Cubic coplanarity(const Relative<double>& r0, const Relative<double>& r1) {
  const Vector<double> da = r1.a - r0.a, db = r1.b - r0.b, dq = r1.q - r0.q;
  const Vector<double> n0 = cross(r0.a, r0.b), n2 = cross(da, db);
  Vector<double> n1 = cross(r0.a, db);
  const Vector<double> other = cross(da, r0.b);
  for (std::size_t k = 0; k < 3; ++k) n1[k] += other[k];
  return {dot(n0, r0.q), dot(n0, dq) + dot(n1, r0.q), dot(n1, dq) + dot(n2, r0.q), dot(n2, dq)};
}

// 0, 1 and between them the times at which the cubic turns.
std::vector<double> monotone_pieces(const Cubic& c) {
  std::vector<double> ends{0, 1};
  const double a = 3 * c[3], b = c[2], d = b * b - a * c[1];  // a t^2 + 2 b t + c1 = 0
  if (d >= 0) {
    const double s = -(b + std::copysign(std::sqrt(d), b));
    for (const double t : {s / a, c[1] / s})
      if (t > 0 && t < 1) ends.push_back(t);
  }
  std::sort(ends.begin(), ends.end());
  return ends;
}

// Ascending, at most one from each monotone piece.
std::vector<double> roots(const Cubic& c) {
  std::vector<double> found;
  const auto f = [&](double t) { return value(c, t); };
  const std::vector<double> ends = monotone_pieces(c);
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double x = ends[i], y = ends[i + 1], fx = f(x), fy = f(y);
    if (fx == 0) found.push_back(x);
    if (fx * fy < 0) {
      boost::uintmax_t steps = 100;
      const auto [low, high] = boost::math::tools::toms748_solve(
          f, x, y, fx, fy, boost::math::tools::eps_tolerance<double>(), steps);
      found.push_back(0.5 * (low + high));
    }
    if (fy == 0) found.push_back(y);
  }
  return found;
}

bool touches(onset::PairKind kind, const Relative<double>& r, double tolerance) {
  const Vector<double> n = cross(r.a, r.b);
  const double whole = dot(n, n);
  if (!(whole > 0)) return false;
  const double u = dot(cross(r.q, r.b), n) / whole, v = dot(cross(r.a, r.q), n) / whole;
  const double most = kind == onset::PairKind::vertex_face ? u + v : std::max(u, v);
  return u >= -tolerance && v >= -tolerance && most <= 1 + tolerance;
}

}  // namespace

FinderAnswer floating_point_cubic(onset::PairKind kind, const TruthQuery& query, double tolerance) {
  const auto at = [&](double t) { return relative(kind, positions(query, t)); };
  const Cubic c = coplanarity(at(0), at(1));
  if (c == Cubic{}) return {};
  for (const double t : roots(c))
    if (touches(kind, at(t), tolerance)) return {true, t, false};
  return {};
}

}  // namespace app
