#include "tests/in_plane/support/plane_truth.hpp"

#include "tests/oracle/arithmetic/root.hpp"

namespace onset::tests {
namespace {

using oracle::Rational;
using Polynomial = oracle::Polynomial<Rational>;

int side(const PlanePoint& a, const PlanePoint& b, const PlanePoint& p) {
  const Rational ux = Rational(b[0]) - a[0], uy = Rational(b[1]) - a[1];
  return oracle::sign<Rational>(ux * (Rational(p[1]) - a[1]) - uy * (Rational(p[0]) - a[0]));
}

}  // namespace

// With w = p - a and e = b - a the two touch where f = w x e = 0 and h = w.(e - w) >= 0.
PlaneTruth plane_truth(const VertexEdgeQuery& q) {
  Polynomial w[2], e[2];
  for (std::size_t k = 0; k < 2; ++k) {
    const auto moving = [&](std::size_t i) {
      return Polynomial::linear(Rational(q.t0[i][k]), Rational(q.t1[i][k]));
    };
    w[k] = moving(0) - moving(1), e[k] = moving(2) - moving(1);
  }
  const Polynomial f = w[0] * e[1] - w[1] * e[0], h = w[0] * (e[0] - w[0]) + w[1] * (e[1] - w[1]);
  const auto found = [](const oracle::Root<Rational>& root) {
    const oracle::Bracket t = oracle::to_doubles(root);
    return PlaneTruth{true, t.lo, t.hi};
  };
  if (f.is_zero()) {
    if (oracle::sign(h.value(Rational(0))) >= 0) return {true, 0, 0};
    const auto roots = oracle::roots_in_unit_interval(h);
    return roots.empty() ? PlaneTruth{} : found(roots.front());
  }
  for (oracle::Root<Rational>& root : oracle::roots_in_unit_interval(f))
    if (oracle::sign_at(h, root) >= 0) return found(root);
  return {};
}

bool touch(const PlanePoint& p, const PlanePoint& a, const PlanePoint& b) {
  if (side(a, b, p) != 0) return false;
  Rational h = 0;
  for (std::size_t k = 0; k < 2; ++k) h += (Rational(p[k]) - a[k]) * (Rational(b[k]) - p[k]);
  return oracle::sign(h) >= 0;
}

bool edges_meet(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c, const PlanePoint& d) {
  if (touch(a, c, d) || touch(b, c, d) || touch(c, a, b) || touch(d, a, b)) return true;
  return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

}  // namespace onset::tests
