#include "narrowphase/distance/contact_geometry.hpp"

#include <algorithm>
#include <cmath>

#include "narrowphase/distance/closest_points.hpp"
#include "narrowphase/distance/precise_differences.hpp"
#include "narrowphase/exact/complete.hpp"
#include "narrowphase/kernel/kernels.hpp"

namespace onset {
namespace {

// Of the pair's size: the rounding of t and the weights cannot turn the direction of a wider gap by much.
constexpr double kResolved = 0x1p-46;
// Of a length: rounding leaves no more of a part that is 0.
constexpr double kNothing = 0x1p-40;

double length(const Vec& v) { return std::sqrt(dot(v, v)); }

// An odd exchange of axes turns a cross product round.
bool odd(const std::array<int, 3>& axes) { return (axes[1] - axes[0] + 3) % 3 != 1; }

Vec square_to(const Vec& e) {
  Vec axis{};
  int least = 2;
  for (int i = 1; i >= 0; --i)
    if (std::fabs(e[i]) < std::fabs(e[least])) least = i;
  axis[least] = 1;
  const Vec n = cross(e, axis);
  return dot(n, n) > 0 ? unit(n) : axis;
}

double coordinate(const double (&weights)[4], PairKind kind) {  // U
  return kind != PairKind::edge_edge ? -weights[2] : weights[1];
}

// How p1 - p2 changes over the whole step.
VecOf<DoubleDouble> motion_of(const PreciseMotion& m, const double (&weights)[4]) {
  const DoubleDouble U = coordinate(weights, m.start.kind), V = -weights[3];
  return ((m.end.q - m.start.q) - U * (m.end.a - m.start.a)) - V * (m.end.b - m.start.b);
}

// Finds the normal of a pair that touches, or nearly does at a boundary.
class Touching {
 public:
  Touching(const ExactPair& pair, const Differences<DoubleDouble>& d, const ClosestPoints& near, double size,
           const Vec& past, double t, bool odd_axes)
      : pair_(pair), d_(d), near_(near), plane_(d), size_(size), past_(past), t_(t), odd_axes_(odd_axes) {
    if (pair.kind == PairKind::vertex_edge)
      across_ = unit(Vec{{-d.a[1].hi, d.a[0].hi, 0}});
    else if (plane_.resolved)
      across_ = unit(rounded((plane_.swapped ? -1.0 : 1.0) * plane_.normal()));
  }

  // Returns the side of a x b that the pair came from, inside both primitives; 0: not known.
  int side() const {
    if (pair_.kind == PairKind::vertex_edge) return side_in_plane();
    const int s = side_before(pair_, t_);
    return pair_.kind != PairKind::edge_edge ? s : -s;
  }
  Vec inside(int side) const {
    if (side != 0) return double(side) * across_;
    const double towards = dot(across_, past_);
    return std::fabs(towards) > kNothing * length(past_) ? (towards > 0 ? across_ : -1 * across_) : wound();
  }

  // At a boundary: along p1 - p2, or across the plane, if the pair came from there; else along its way.
  Vec at_boundary() const {
    const Vec direction = vec(near_.normal);
    if (near_.lower > 0 && came_along(direction)) return direction;
    if (plane_.resolved && came_from(across_))
      if (const Vec n = double(side_here()) * across_; came_along(n)) return n;
    return along_way();
  }

 private:
  // Of a x q, which errs by less than 2^-93 of its size (docs/two-dimensions.md).
  int side_in_plane() const {
    const double here = (d_.a[0] * d_.q[1] - d_.a[1] * d_.q[0]).hi;
    if (std::fabs(here) > 0x1p-90 * size_ * size_) return here > 0 ? 1 : -1;
    return side_before(pair_, t_);
  }
  bool came_along(const Vec& n) const { return dot(n, past_) > kNothing * length(past_); }
  bool came_from(const Vec& n) const { return came_along(n) || came_along(-1 * n); }
  int side_here() const {
    const VecOf<DoubleDouble> n = plane_.normal();
    const double here = dot(d_.q, n).hi;
    const bool told = std::fabs(here) > 0x1p-90 * size_ * length(rounded(n));
    return !told ? side() : (here > 0) != plane_.swapped ? 1 : -1;
  }
  // The winding decides where nothing moves.
  Vec wound() const { return odd_axes_ ? -1 * across_ : across_; }

  // Within the plane; or square to the longest edge, or along it, end on end. At rest p1 - p2 decides, else
  // the winding, or any direction square to the edge.
  Vec along_way() const {
    const bool thin = !(plane_.width2.hi > 0x1p-80 * plane_.length2.hi);
    const Vec e = thin ? unit(rounded(plane_.along)) : Vec{}, n = past_ - dot(past_, e) * e;
    if (length(n) > kNothing * length(past_)) return unit(n - dot(n, e) * e);
    if (length(past_) > 0) return unit(past_);
    if (near_.lower > 0) return vec(near_.normal);
    return thin ? square_to(e) : wound();
  }

  const ExactPair& pair_;
  const Differences<DoubleDouble>& d_;
  const ClosestPoints& near_;
  const PairPlane<DoubleDouble> plane_;
  const double size_;
  const Vec past_;
  const double t_;
  const bool odd_axes_;
  Vec across_{};  // a x b
};

struct Geometry {
  ClosestPoints near;
  Vec normal;
  double speed, unit;
  bool degenerate;
};

// Finds all in doubles; false where the gap is not wide, or the motion along it not more than rounding. Mixed
// differences err by 4u, motions by 12u of their sizes, the direction by 2^-17 where features tie and else by
// 2^-40 (docs/theory.md, §16.4).
bool wide_geometry(const ExactPair& pair, double t, Geometry& f) {
  const double scale = inverse_unit(
      std::max(largest_corner_component(pair.kind, pair.t0), largest_corner_component(pair.kind, pair.t1)));
  const Differences<double> start = rounded_differences(pair.kind, pair.t0, scale),
                            end = rounded_differences(pair.kind, pair.t1, scale);
  const auto mixed = [t](const Vec& x, const Vec& y) { return (1 - t) * x + t * y; };
  Differences<double> d{pair.kind, mixed(start.q, end.q), mixed(start.a, end.a), mixed(start.b, end.b), {}};
  for (int k = 0; k < d.corners(); ++k) d.corner[k] = mixed(start.corner[k], end.corner[k]);
  constexpr double kLargest = 4;  // corners are no longer
  if (!quick_closest_points(d, 0x1p-51 * kLargest, f.near) || !(f.near.lower > 0x1p-12 * kLargest))
    return false;
  const double U = coordinate(f.near.weights, pair.kind), V = -f.near.weights[3];
  const auto at = [&](const Differences<double>& x) { return (x.q - U * x.a) - V * x.b; };
  f.normal = vec(f.near.normal);
  f.speed = dot(f.normal, at(end) - at(start));
  f.unit = 1 / scale;
  f.degenerate = false;
  return std::fabs(f.speed) > 0x1p-46 * kLargest || (f.speed == 0 && rests(pair));
}

Geometry precise_geometry(const ExactPair& pair, double t, bool parting, bool odd_axes) {
  const PreciseMotion precise(pair.kind, pair.t0, pair.t1);
  const Differences<DoubleDouble> d = precise.at(t);
  Geometry f{precise_closest_points(d, precise.blur(t)), {}, 0, precise.unit, false};
  f.normal = vec(f.near.normal);
  const VecOf<DoubleDouble> moved = motion_of(precise, f.near.weights);
  const bool in_plane = pair.kind == PairKind::vertex_edge;
  const bool inside = in_plane ? f.near.weights[1] != 0 && f.near.weights[2] != 0
                               : f.near.square && std::none_of(f.near.weights, f.near.weights + 4,
                                                               [](double w) { return w == 0; });
  if (!(f.near.lower > (inside && !in_plane ? 0 : kResolved * precise.size))) {
    const Vec past = rounded((parting ? 1.0 : -1.0) * moved);
    const Touching touching(pair, d, f.near, precise.size, past, t, odd_axes);
    const int side = inside ? touching.side() : 0;
    f.normal = inside ? touching.inside(side) : touching.at_boundary();
    f.degenerate = side == 0;
    if (in_plane && f.normal[2] != 0) f.normal = {{1, 0, 0}};  // nothing tells a direction
  }
  f.speed = dot(VecOf<DoubleDouble>{{f.normal[0], f.normal[1], f.normal[2]}}, moved).hi;
  return f;
}

}  // namespace

ContactGeometry contact_geometry(PairKind kind, const Motion& motion, const std::array<int, 4>& vertices,
                                 double t, bool parting) {
  const ExactPair pair = exact_pair(kind, motion, vertices);
  Geometry f;
  if (!wide_geometry(pair, t, f)) f = precise_geometry(pair, t, parting, odd(motion.axes));
  ContactGeometry r;
  std::copy(f.near.weights, f.near.weights + 4, r.weights.begin());
  for (int i = 0; i < 3; ++i) r.normal[std::size_t(motion.axes[std::size_t(i)])] = f.normal[i] + 0.0;
  r.gap = f.near.distance * f.unit;
  r.speed = f.speed * f.unit + 0.0;
  r.degenerate = f.degenerate;
  return r;
}

void contact_geometries(InstructionSet kernel, PairKind kind, const Motion& motion,
                        const std::array<int, 4>* vertices, const double* t, const bool* parting,
                        std::size_t count, ContactGeometry* out) {
  const KernelsOfKind& kernels = kernels_for(kernel).of_kind[int(kind)];
  constexpr std::size_t kAtOnce = 64;
  KernelContact found[kAtOnce];
  KernelPairs pairs{};
  pairs.x = motion.x.data();
  for (std::size_t first = 0; first < count; first += kAtOnce) {
    pairs.vertices = reinterpret_cast<const int(*)[4]>(vertices + first);
    pairs.count = int(std::min(kAtOnce, count - first));
    kernels.contact_geometry(pairs, t + first, found);
    for (int i = 0; i < pairs.count; ++i) {
      const KernelContact& f = found[i];
      const std::size_t row = first + std::size_t(i);
      ContactGeometry& r = out[row];
      if (!f.ordinary) {
        r = contact_geometry(kind, motion, vertices[row], t[row], parting[row]);
        continue;
      }
      r = {{f.weight[0], f.weight[1], f.weight[2], f.weight[3]}, {}, f.gap, f.speed, false};
      for (std::size_t a = 0; a < 3; ++a) r.normal[std::size_t(motion.axes[a])] = f.normal[a];
    }
  }
}

}  // namespace onset
