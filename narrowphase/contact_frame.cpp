#include "narrowphase/contact_frame.hpp"

#include <algorithm>
#include <cmath>

#include "narrowphase/closest_points.hpp"
#include "narrowphase/exact_complete.hpp"
#include "narrowphase/kernels.hpp"
#include "narrowphase/precise_differences.hpp"

namespace onset {
namespace {

// Of the pair's size. A gap that is wider gives a direction that neither the rounding of t nor that of the
// weights, each a few 2^-53 of the size, can turn by much.
constexpr double kResolved = 0x1p-46;
// Of a length: what rounding in doubles leaves of a product or a part of it that is 0.
constexpr double kNothing = 0x1p-40;

double length(const Vec& v) { return std::sqrt(dot(v, v)); }

// Exchanging axes an odd number of times turns a cross product round.
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

ExactPair exact_pair(PairKind kind, const Motion& motion, const std::array<int, 4>& vertices) {
  ExactPair r{kind, {}, {}};
  for (std::size_t i = 0; i < 4; ++i) r.t0[i] = motion.t0(vertices[i]), r.t1[i] = motion.t1(vertices[i]);
  return r;
}

// How p1 - p2 changes over the whole step.
VecOf<DoubleDouble> motion_of(const PreciseMotion& m, const double (&weights)[4]) {
  const DoubleDouble U = m.start.kind == PairKind::vertex_face ? -weights[2] : weights[1], V = -weights[3];
  return ((m.end.q - m.start.q) - U * (m.end.a - m.start.a)) - V * (m.end.b - m.start.b);
}

// A pair whose gap does not give its normal: it touches, or is at a boundary with next to no gap.
class Touching {
 public:
  Touching(const ExactPair& pair, const Differences<DoubleDouble>& d, const ClosestPoints& near,
           const Vec& past, double t, bool odd_axes)
      : pair_(pair), d_(d), near_(near), plane_(d), past_(past), t_(t), odd_axes_(odd_axes) {
    if (plane_.resolved) across_ = unit(rounded((plane_.swapped ? -1.0 : 1.0) * plane_.normal()));
  }

  // Inside both primitives: across the plane, on the side that the pair came from. 0: not known.
  int side() const {
    const int s = side_before(pair_, t_);  // of a x b, with the form of the exact decision
    return pair_.kind == PairKind::vertex_face ? s : -s;
  }
  Vec inside(int side) const {
    if (side != 0) return double(side) * across_;
    const double towards = dot(across_, past_);
    return std::fabs(towards) > kNothing * length(past_) ? (towards > 0 ? across_ : -1 * across_) : wound();
  }

  // At a boundary: along p1 - p2, or across the plane, if that is where the pair came from; else along its
  // way.
  Vec at_boundary() const {
    const Vec direction = vec(near_.direction);
    if (near_.lower > 0 && came_along(direction)) return direction;
    if (plane_.resolved && came_from(across_))
      if (const Vec n = double(side_here()) * across_; came_along(n)) return n;
    return along_way();
  }

 private:
  bool came_along(const Vec& n) const { return dot(n, past_) > kNothing * length(past_); }
  bool came_from(const Vec& n) const { return came_along(n) || came_along(-1 * n); }
  int side_here() const {
    const double here = dot(d_.q, plane_.normal()).hi;
    if (near_.lower > 0 && std::fabs(here) > 0x1p-90) return (here > 0) != plane_.swapped ? 1 : -1;
    return side();
  }
  // The winding decides on either side of a face, or between edges, that nothing moves from.
  Vec wound() const { return odd_axes_ ? -1 * across_ : across_; }

  // Within the plane; or square to the longest edge, or along it, end on end. At rest p1 - p2 decides, or the
  // winding, or, without one, any direction square to the edge.
  Vec along_way() const {
    const bool thin = !(plane_.width2.hi > 0x1p-80 * plane_.length2.hi);
    const Vec e = thin ? unit(rounded(plane_.along)) : Vec{}, n = past_ - dot(past_, e) * e;
    if (length(n) > kNothing * length(past_)) return unit(n - dot(n, e) * e);
    if (length(past_) > 0) return unit(past_);
    if (near_.lower > 0) return vec(near_.direction);
    return thin ? square_to(e) : wound();
  }

  const ExactPair& pair_;
  const Differences<DoubleDouble>& d_;
  const ClosestPoints& near_;
  const Plane<DoubleDouble> plane_;
  const Vec past_;
  const double t_;
  const bool odd_axes_;
  Vec across_{};  // a x b
};

}  // namespace

ContactFrame contact_frame(PairKind kind, const Motion& motion, const std::array<int, 4>& vertices, double t,
                           bool parting) {
  const ExactPair pair = exact_pair(kind, motion, vertices);
  const PreciseMotion precise(kind, pair.t0, pair.t1);
  const Differences<DoubleDouble> d = precise.at(t);
  const ClosestPoints near = precise_closest_points(d, t == 0 ? 0 : PreciseMotion::kBlur);
  const VecOf<DoubleDouble> moved = motion_of(precise, near.weights);
  const bool inside =
      near.square && std::none_of(near.weights, near.weights + 4, [](double w) { return w == 0; });
  ContactFrame r;
  Vec n = vec(near.direction);
  if (!(near.lower > (inside ? 0 : kResolved * precise.size))) {
    const Vec past = rounded((parting ? 1.0 : -1.0) * moved);
    const Touching touching(pair, d, near, past, t, odd(motion.axes));
    const int side = inside ? touching.side() : 0;
    n = inside ? touching.inside(side) : touching.at_boundary();
    r.degenerate = side == 0;
  }
  std::copy(near.weights, near.weights + 4, r.weight.begin());
  for (int i = 0; i < 3; ++i) r.normal[std::size_t(motion.axes[std::size_t(i)])] = n[i] + 0.0;
  r.gap = near.distance * precise.unit;
  r.speed = dot(VecOf<DoubleDouble>{{n[0], n[1], n[2]}}, moved).hi * precise.unit + 0.0;
  return r;
}

void contact_frames(Kernel kernel, PairKind kind, const Motion& motion, const std::array<int, 4>* vertices,
                    const double* t, const bool* parting, std::size_t count, ContactFrame* frames) {
  const KernelTable& kernels = kernels_for(kernel);
  const auto of_kind = kind == PairKind::vertex_face ? kernels.frames_vertex_face : kernels.frames_edge_edge;
  constexpr std::size_t kAtOnce = 64;
  KernelFrame found[kAtOnce];
  KernelPairs pairs{};
  pairs.x = motion.x.data();
  for (std::size_t first = 0; first < count; first += kAtOnce) {
    pairs.vertices = reinterpret_cast<const int (*)[4]>(vertices + first);
    pairs.count = int(std::min(kAtOnce, count - first));
    of_kind(pairs, t + first, found);
    for (int i = 0; i < pairs.count; ++i) {
      const KernelFrame& f = found[i];
      const std::size_t row = first + std::size_t(i);
      ContactFrame& r = frames[row];
      if (!f.ordinary) {
        r = contact_frame(kind, motion, vertices[row], t[row], parting[row]);
        continue;
      }
      r = {{f.weight[0], f.weight[1], f.weight[2], f.weight[3]}, {}, f.gap, f.speed, false};
      for (std::size_t a = 0; a < 3; ++a) r.normal[std::size_t(motion.axes[a])] = f.normal[a];
    }
  }
}

}  // namespace onset
