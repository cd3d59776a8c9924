#include "narrowphase/closest_points.hpp"

#include "narrowphase/nearest.hpp"

namespace onset {
namespace {

// In units of a power of two, so that the largest component of a corner difference is in [1, 2) or all are 0
// (of subnormal ones it is in [2^-53, 2)).
double inverse_unit(double largest) {
  return largest > 0 ? std::ldexp(1.0, -std::max(std::ilogb(largest), -1021)) : 1;
}

Vec difference(const double* p, const double* q, double scale) {
  return {{(p[0] - q[0]) * scale, (p[1] - q[1]) * scale, (p[2] - q[2]) * scale}};
}
VecOf<DoubleDouble> precise_difference(const double* p, const double* q, double scale) {
  VecOf<DoubleDouble> r;
  for (int i = 0; i < 3; ++i) r[i] = scaled(two_difference(p[i], q[i]), scale);
  return r;
}

// One rounding each.
Differences<double> differences(PairKind kind, const double* const (&x)[4], double scale) {
  const bool triangle = kind == PairKind::vertex_face;
  Differences<double> d{kind, {}, {}, {}, {}};
  for (int k = 0; k < d.corners(); ++k)
    d.corner[k] = triangle ? difference(x[0], x[1 + k], scale) : difference(x[k / 2], x[2 + k % 2], scale);
  d.q = d.corner[0];
  d.a = triangle ? difference(x[2], x[1], scale) : difference(x[0], x[1], scale);
  d.b = triangle ? difference(x[3], x[1], scale) : difference(x[3], x[2], scale);
  return d;
}
// None but where 2^-1074 is too coarse, and 3u^2 of the corners.
Differences<DoubleDouble> precise_differences(PairKind kind, const double* const (&x)[4], double scale) {
  const bool triangle = kind == PairKind::vertex_face;
  Differences<DoubleDouble> d{kind, {}, {}, {}, {}};
  d.q = precise_difference(x[0], x[triangle ? 1 : 2], scale);
  d.a = triangle ? precise_difference(x[2], x[1], scale) : precise_difference(x[0], x[1], scale);
  d.b = triangle ? precise_difference(x[3], x[1], scale) : precise_difference(x[3], x[2], scale);
  return d;
}

double largest_component(PairKind kind, const double* const (&x)[4]) {
  const int side = kind == PairKind::vertex_face ? 1 : 2;
  double r = 0;
  for (int i = 0; i < side; ++i)
    for (int j = side; j < 4; ++j)
      for (int a = 0; a < 3; ++a) r = std::max(r, std::fabs(x[i][a] - x[j][a]));
  return r;
}

double largest_corner(const Differences<double>& d) {
  double r = 0;
  for (int k = 0; k < d.corners(); ++k) r = std::max(r, dot(d.corner[k], d.corner[k]));
  return std::sqrt(r);
}

// U and V to multiples of 2^-52, which moves the point by no more than u |a| + 2u |b|.
struct Foot {
  double U, V;
};
Foot rounded(PairKind kind, double U, double V) {
  const Foot r{std::clamp((1 + U) - 1, 0.0, 1.0), std::clamp((1 + V) - 1, 0.0, 1.0)};
  return kind == PairKind::vertex_face ? Foot{r.U, std::min(r.V, 1 - r.U)} : r;
}

void put_weights(PairKind kind, const Foot& f, double (&w)[4]) {
  const bool triangle = kind == PairKind::vertex_face;
  w[0] = triangle ? 1 : 1 - f.U, w[1] = triangle ? -(1 - f.U - f.V) : f.U;
  w[2] = triangle ? -f.U : -(1 - f.V), w[3] = -f.V;
  for (double& x : w) x += 0.0;  // no -0
}

void put_direction(const Vec& n, double (&direction)[3]) {
  for (int i = 0; i < 3; ++i) direction[i] = n[i] + 0.0;
}

// Convexly, from the corners: each is off by u of its size; with a triangle's exact weights the products and
// two sums add 3u, with a square's two rounds of a product and a sum 4u: below 5u rho in all.
Vec point_at(const Differences<double>& d, const Foot& f) {
  const Vec(&c)[4] = d.corner;
  if (d.kind == PairKind::vertex_face) return ((1 - f.U - f.V) * c[0] + f.U * c[1]) + f.V * c[2];
  const Vec first = (1 - f.V) * c[0] + f.V * c[1], second = (1 - f.V) * c[2] + f.V * c[3];
  return (1 - f.U) * first + f.U * second;
}

// In units of the pair. A point's length is off by 5u rho and, with the square root, 2.5u of itself. A
// margin: the products with a corner by 4u |n| rho, its own u included, the length of n and the quotient
// by 3.5u of the result. Both stay below 8u rho, second order included; `blur` is what else the differences
// are off by.
struct Bounds {
  double distance, lower, upper;
};
constexpr double kRounding = 0x1p-50, kWidest = 0x1.8p-48;  // 8u, 48u

// In doubles; false: they do not tell, be it for a tie, for a primitive that is too thin, or as the pair may
// touch.
bool look(const Differences<double>& d, double blur, ClosestPoints& r, Bounds& bounds) {
  const Plane<double> plane(d);
  Nearest<double> nearest;
  nearest.inside = plane.resolved && foot_on_plane(d, plane, nearest);
  if (nearest.inside) {
    const Vec n = plane.normal();
    nearest.direction = dot(n, d.q) < 0 ? -1 * n : n;
  } else {
    nearest = nearest_on_sides(d);
  }
  const double rho = largest_corner(d) * (1 + 0x1p-50), error = kRounding * rho + 2 * blur;
  double most = margin(d, nearest.direction);
  const Foot foot = rounded(d.kind, nearest.U, nearest.V);
  const Vec w = point_at(d, foot);
  bounds.distance = std::sqrt(dot(w, w));
  bounds.upper = bounds.distance + error;
  if (plane.resolved && !nearest.inside && bounds.upper - (most - error) > kWidest * rho) {
    const Vec n = plane.normal(), towards = dot(n, d.q) < 0 ? -1 * n : n;
    if (const double across = margin(d, towards); across > most) most = across, nearest.direction = towards;
  }
  bounds.lower = most - error;
  put_weights(d.kind, foot, r.weights);
  put_direction(unit(nearest.direction), r.direction);
  r.square = nearest.inside;
  return bounds.lower > 0 && bounds.upper - bounds.lower <= kWidest * rho;
}

VecOf<DoubleDouble> unit(const VecOf<DoubleDouble>& n) {
  const DoubleDouble nn = dot(n, n);
  return nn.hi > 0x1p-400 ? (DoubleDouble(1.0) / sqrt(nn)) * n : VecOf<DoubleDouble>{};
}

// In double-doubles all features are found, and directions made square to them, within 2^-98 rho: a direction
// that is off by that relative to the distance costs the far ends of a feature 2^-98 rho^2 / distance of
// their margin, less than 4u rho where the distance is more than 2^-47 rho; where it is less, 0 is close
// enough a bound.
void look_closer(const Differences<DoubleDouble>& d, double rho, double blur, ClosestPoints& r,
                 Bounds& bounds) {
  using V = VecOf<DoubleDouble>;
  const Plane<DoubleDouble> plane(d);
  const auto towards = [&](const V& n) { return dot(n, d.q).hi < 0 ? DoubleDouble(-1.0) * n : n; };
  Nearest<DoubleDouble> nearest;
  nearest.inside = plane.resolved && foot_on_plane(d, plane, nearest);
  if (!nearest.inside) nearest = nearest_on_sides(d);
  if (nearest.inside) nearest.direction = towards(plane.normal());
  DoubleDouble most = margin(d, nearest.direction);
  if (plane.resolved && !nearest.inside) {
    const V n = towards(plane.normal());
    if (const DoubleDouble across = margin(d, n); across > most) most = across, nearest.direction = n;
  }
  const Foot foot = rounded(d.kind, nearest.U.hi, nearest.V.hi);
  const V w = (d.q - DoubleDouble(foot.U) * d.a) - DoubleDouble(foot.V) * d.b;
  // Products with a corner and the quotient by its length err by less than 80 u^2, a point by less than 60
  // u^2 of rho.
  const double error = 0x1p-98 * rho + 2 * blur;
  bounds.distance = sqrt(dot(w, w)).hi;
  bounds.upper = bounds.distance * (1 + 0x1p-50) + error;
  bounds.lower = std::max(most.hi * (1 - 0x1p-51) - error, 0.0);
  put_weights(d.kind, foot, r.weights);
  const V n = unit(nearest.direction);
  put_direction({{n[0].hi, n[1].hi, n[2].hi}}, r.direction);
  r.square = nearest.inside;
}

ClosestPoints in_model_length(ClosestPoints r, const Bounds& b, double scale) {
  const double unit = 1 / scale, last = 0x1p-1074;
  r.distance = b.distance * unit, r.lower = std::max(b.lower * unit - last, 0.0),
  r.upper = b.upper * unit + last;
  return r;
}

ClosestPoints at_one_place(PairKind kind) {
  ClosestPoints r{};
  put_weights(kind, {0, 0}, r.weights);
  r.upper = 0x1p-1074;
  return r;
}

}  // namespace

ClosestPoints closest_points(PairKind kind, const double* const (&x)[4]) {
  const double largest = largest_component(kind, x), scale = inverse_unit(largest);
  if (largest == 0) return at_one_place(kind);
  ClosestPoints r;
  Bounds bounds;
  const Differences<double> d = differences(kind, x, scale);
  if (!look(d, 0, r, bounds)) {
    Differences<DoubleDouble> precise = precise_differences(kind, x, scale);
    precise.set_corners();
    look_closer(precise, largest_corner(d), 0, r, bounds);
  }
  return in_model_length(r, bounds, scale);
}

ClosestPoints closest_points(PairKind kind, const double* const (&x0)[4], const double* const (&x1)[4],
                             double t) {
  const double largest = std::max(largest_component(kind, x0), largest_component(kind, x1));
  if (largest == 0) return at_one_place(kind);
  const double scale = inverse_unit(largest);
  Differences<DoubleDouble> precise = precise_differences(kind, x0, scale);
  const Differences<DoubleDouble> end = precise_differences(kind, x1, scale);
  const auto move = [&](VecOf<DoubleDouble>& v, const VecOf<DoubleDouble>& to) {
    v = v + DoubleDouble(t) * (to - v);
  };
  move(precise.q, end.q), move(precise.a, end.a), move(precise.b, end.b);
  precise.set_corners();
  const auto near = [](const VecOf<DoubleDouble>& v) { return Vec{{v[0].hi, v[1].hi, v[2].hi}}; };
  Differences<double> d{kind, near(precise.q), near(precise.a), near(precise.b), {}};
  for (int k = 0; k < d.corners(); ++k) d.corner[k] = near(precise.corner[k]);
  // Mixing q, a and b and taking their sums errs by less than 100 u^2 of the sizes at both ends, at most 2^3
  // here.
  constexpr double kBlur = 0x1p-96;
  ClosestPoints r;
  Bounds bounds;
  if (!look(d, kBlur, r, bounds)) look_closer(precise, largest_corner(d), kBlur, r, bounds);
  return in_model_length(r, bounds, scale);
}

}  // namespace onset
