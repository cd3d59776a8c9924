#include "narrowphase/distance/precise_differences.hpp"

namespace onset {
namespace {

Vec rounded_difference(const double* p, const double* q, double scale) {
  return {{(p[0] - q[0]) * scale, (p[1] - q[1]) * scale, (p[2] - q[2]) * scale}};
}
VecOf<DoubleDouble> difference(const double* p, const double* q, double scale) {
  VecOf<DoubleDouble> r;
  for (int i = 0; i < 3; ++i) r[i] = scaled(two_difference(p[i], q[i]), scale);
  return r;
}

double largest_corner(const Differences<DoubleDouble>& d) {
  double r = 0;
  for (int k = 0; k < d.corners(); ++k) {
    const Vec c = rounded(d.corner[k]);
    r = std::max(r, dot(c, c));
  }
  return std::sqrt(r) * (1 + 0x1p-50);
}

}  // namespace

double largest_corner_component(PairKind kind, const double* const (&x)[4]) {
  const int side = kind != PairKind::edge_edge ? 1 : 2;
  double r = 0;
  for (int i = 0; i < side; ++i)
    for (int j = side; j < 4; ++j)
      for (int a = 0; a < 3; ++a) r = std::max(r, std::fabs(x[i][a] - x[j][a]));
  return r;
}

double inverse_unit(double largest) {
  return largest > 0 ? std::ldexp(1.0, -std::max(std::ilogb(largest), -1021)) : 1;
}

Differences<double> rounded_differences(PairKind kind, const double* const (&x)[4], double scale) {
  const bool triangle = kind != PairKind::edge_edge;
  Differences<double> d{kind, {}, {}, {}, {}};
  for (int k = 0; k < d.corners(); ++k)
    d.corner[k] = triangle ? rounded_difference(x[0], x[1 + k], scale)
                           : rounded_difference(x[k / 2], x[2 + k % 2], scale);
  d.q = d.corner[0];
  d.a = triangle ? rounded_difference(x[2], x[1], scale) : rounded_difference(x[0], x[1], scale);
  d.b = triangle ? rounded_difference(x[3], x[1], scale) : rounded_difference(x[3], x[2], scale);
  return d;
}

Differences<DoubleDouble> precise_differences(PairKind kind, const double* const (&x)[4], double scale) {
  const bool triangle = kind != PairKind::edge_edge;
  Differences<DoubleDouble> d{kind, {}, {}, {}, {}};
  d.q = difference(x[0], x[triangle ? 1 : 2], scale);
  d.a = triangle ? difference(x[2], x[1], scale) : difference(x[0], x[1], scale);
  d.b = triangle ? difference(x[3], x[1], scale) : difference(x[3], x[2], scale);
  d.set_corners();
  return d;
}

PreciseMotion::PreciseMotion(PairKind kind, const double* const (&x0)[4], const double* const (&x1)[4]) {
  const double scale =
      inverse_unit(std::max(largest_corner_component(kind, x0), largest_corner_component(kind, x1)));
  unit = 1 / scale;
  start = precise_differences(kind, x0, scale);
  end = precise_differences(kind, x1, scale);
  size = std::max(largest_corner(start), largest_corner(end));
}

Differences<DoubleDouble> PreciseMotion::at(double t) const {
  if (t == 0) return start;
  const auto mixed = [t](const VecOf<DoubleDouble>& from, const VecOf<DoubleDouble>& to) {
    return from + DoubleDouble(t) * (to - from);
  };
  Differences<DoubleDouble> d = start;
  d.q = mixed(start.q, end.q), d.a = mixed(start.a, end.a), d.b = mixed(start.b, end.b);
  d.set_corners();
  return d;
}

}  // namespace onset
