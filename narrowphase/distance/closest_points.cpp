#include "narrowphase/distance/closest_points.hpp"

#include "narrowphase/distance/precise_differences.hpp"

namespace onset {
namespace {

double largest_corner(const Differences<double>& d) {
  double r = 0;
  for (int k = 0; k < d.corners(); ++k) r = std::max(r, dot(d.corner[k], d.corner[k]));
  return std::sqrt(r);
}

// Rounding to multiples of 2^-52 moves the point by at most u |a| + 2u |b|.
struct Foot {
  double U, V;
};
Foot rounded(PairKind kind, double U, double V) {
  const Foot r{std::clamp((1 + U) - 1, 0.0, 1.0), std::clamp((1 + V) - 1, 0.0, 1.0)};
  return kind != PairKind::edge_edge ? Foot{r.U, std::min(r.V, 1 - r.U)} : r;
}

void put_weights(PairKind kind, const Foot& f, double (&w)[4]) {
  const bool triangle = kind != PairKind::edge_edge;
  w[0] = triangle ? 1 : 1 - f.U, w[1] = triangle ? -(1 - f.U - f.V) : f.U;
  w[2] = triangle ? -f.U : -(1 - f.V), w[3] = -f.V;
  if (kind == PairKind::vertex_edge) w[2] += w[3], w[3] = 0;  // both are e1's, and multiples of 2^-52
  for (double& x : w) x += 0.0;                               // no -0
}

void put_direction(const Vec& n, double (&direction)[3]) {
  for (int i = 0; i < 3; ++i) direction[i] = n[i] + 0.0;
}

// Computes the point as a convex mean of the corners, within 5u rho (docs/theory.md, L42).
Vec point_at(const Differences<double>& d, const Foot& f) {
  const Vec(&c)[4] = d.corner;
  if (d.kind != PairKind::edge_edge) return ((1 - f.U - f.V) * c[0] + f.U * c[1]) + f.V * c[2];
  const Vec first = (1 - f.V) * c[0] + f.V * c[1], second = (1 - f.V) * c[2] + f.V * c[3];
  return (1 - f.U) * first + f.U * second;
}

// In units of the pair. A point's length and a margin err by 7.5u rho, for which 8u is taken (docs/theory.md,
// L42); `blur` is what else the differences are off by.
struct Bounds {
  double distance, lower, upper;
};
constexpr double kRounding = 0x1p-50, kWidest = 0x1.8p-48;  // 8u, 48u

// Finds all in doubles. Returns false where they do not tell: for ties, thin primitives, and pairs that may
// touch.
bool find(const Differences<double>& d, double blur, ClosestPoints& r, Bounds& bounds) {
  const PairPlane<double> plane(d);
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
  if (plane.resolved && !nearest.inside && bounds.upper - (most - error) > kWidest * rho + 8 * blur) {
    const Vec n = plane.normal(), towards = dot(n, d.q) < 0 ? -1 * n : n;
    if (const double across = margin(d, towards); across > most) most = across, nearest.direction = towards;
  }
  bounds.lower = most - error;
  put_weights(d.kind, foot, r.weights);
  put_direction(unit(nearest.direction), r.direction);
  std::copy_n(r.direction, 3, r.normal);
  r.square = nearest.inside;
  return bounds.lower > 0 && bounds.upper - bounds.lower <= kWidest * rho + 8 * blur;
}

VecOf<DoubleDouble> unit(const VecOf<DoubleDouble>& n) {
  const DoubleDouble nn = dot(n, n);
  return nn.hi > 0x1p-400 ? (DoubleDouble(1.0) / sqrt(nn)) * n : VecOf<DoubleDouble>{};
}

// Finds features and directions within 2^-98 rho, which costs a margin 2^-98 rho^2 / distance: below 4u rho
// for distances above 2^-47 rho, while for others 0 is close enough a bound (docs/theory.md, T8).
void find_precisely(const Differences<DoubleDouble>& d, double rho, double blur, ClosestPoints& r,
                    Bounds& bounds) {
  using V = VecOf<DoubleDouble>;
  const PairPlane<DoubleDouble> plane(d);
  const auto towards = [&](const V& n) { return dot(n, d.q).hi < 0 ? DoubleDouble(-1.0) * n : n; };
  Nearest<DoubleDouble> nearest;
  nearest.inside = plane.resolved && foot_on_plane(d, plane, nearest);
  if (!nearest.inside) nearest = nearest_on_sides(d);
  if (nearest.inside) nearest.direction = towards(plane.normal());
  DoubleDouble most = margin(d, nearest.direction);
  put_direction(rounded(unit(nearest.direction)), r.normal);
  std::copy_n(r.normal, 3, r.direction);
  // Where a corner and a side tie, the direction of either is that of the closest points but for rounding; as
  // a certificate it may be worth less than the plane's normal, as what it gives away grows with 1 /
  // distance.
  if (plane.resolved && !nearest.inside) {
    const V n = towards(plane.normal());
    if (const DoubleDouble across = margin(d, n); across > most)
      most = across, put_direction(rounded(unit(n)), r.direction);
  }
  const Foot foot = rounded(d.kind, nearest.U.hi, nearest.V.hi);
  const V w = (d.q - DoubleDouble(foot.U) * d.a) - DoubleDouble(foot.V) * d.b;
  // Margins err by less than 80 u^2 rho, points by 60 u^2 rho (docs/theory.md, L43).
  const double error = 0x1p-98 * rho + 2 * blur;
  bounds.distance = sqrt(dot(w, w)).hi;
  bounds.upper = bounds.distance * (1 + 0x1p-50) + error;
  bounds.lower = std::max(most.hi * (1 - 0x1p-51) - error, 0.0);
  put_weights(d.kind, foot, r.weights);
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
  const double largest = largest_corner_component(kind, x), scale = inverse_unit(largest);
  if (largest == 0) return at_one_place(kind);
  ClosestPoints r;
  Bounds bounds;
  const Differences<double> d = rounded_differences(kind, x, scale);
  if (!find(d, 0, r, bounds))
    find_precisely(precise_differences(kind, x, scale), largest_corner(d), 0, r, bounds);
  return in_model_length(r, bounds, scale);
}

bool quick_closest_points(const Differences<double>& d, double blur, ClosestPoints& r) {
  Bounds bounds;
  const bool told = find(d, blur, r, bounds);
  r.distance = bounds.distance, r.lower = bounds.lower, r.upper = bounds.upper;
  return told;
}

ClosestPoints precise_closest_points(const Differences<DoubleDouble>& d, double blur) {
  double rho2 = 0;
  for (int k = 0; k < d.corners(); ++k) rho2 = std::max(rho2, dot(d.corner[k], d.corner[k]).hi);
  ClosestPoints r;
  Bounds bounds;
  find_precisely(d, std::sqrt(rho2), blur, r, bounds);
  r.distance = bounds.distance, r.lower = bounds.lower, r.upper = bounds.upper;
  return r;
}

ClosestPoints closest_points(PairKind kind, const double* const (&x0)[4], const double* const (&x1)[4],
                             double t) {
  const PreciseMotion motion(kind, x0, x1);
  if (motion.size == 0) return at_one_place(kind);
  const Differences<DoubleDouble> precise = motion.at(t);
  Differences<double> d{kind, rounded(precise.q), rounded(precise.a), rounded(precise.b), {}};
  for (int k = 0; k < d.corners(); ++k) d.corner[k] = rounded(precise.corner[k]);
  const double blur = motion.blur(t);
  ClosestPoints r;
  Bounds bounds;
  if (!find(d, blur, r, bounds)) find_precisely(precise, largest_corner(d), blur, r, bounds);
  return in_model_length(r, bounds, 1 / motion.unit);
}

}  // namespace onset
