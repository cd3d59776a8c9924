#include "narrowphase/contact_frame.hpp"

#include <algorithm>
#include <cmath>

#include "base/orientation.hpp"
#include "narrowphase/corners.hpp"
#include "narrowphase/kernels.hpp"
#include "narrowphase/vec.hpp"

namespace onset {
namespace {

constexpr double kU = 0x1p-53;

// The form that both kinds share: the differences of the two primitives are q - U a - V b, with (U, V) in the
// triangle U, V >= 0, U + V <= 1 (vertex-face), or in the unit square (edge-edge).
struct Differences {
  Vec q, a, b;
  Vec at(double U, double V) const { return q - U * a - V * b; }
};

Differences differences(PairKind kind, const Corners& c, int end) {
  const Vec q = vec(c.c[end][0]), first = vec(c.e[end][0]);
  if (kind == PairKind::vertex_face) return {q, first, -1 * vec(c.e[end][2])};
  return {q, -1 * first, vec(c.e[end][1])};
}

Vec mix(const Vec& x, const Vec& y, double t) { return (1 - t) * x + t * y; }

struct Nearest {
  double U = 0, V = 0;
  bool inside = false;
};

// The plane of a and b by Gram-Schmidt from the longer one, which keeps the nearest point within a few u of
// the edges' size however thin the primitive is.
struct Plane {
  bool swapped = false;  // b is the longer one
  Vec along, across;     // the longer edge, and the other without its part along it
  double share = 0;      // that part, of the longer edge
  bool solvable = false, resolved = false;
};

// `noise`: bound on the error of a and b. 2^10 of it across leaves a normal good to 2^-10.
Plane plane_of(const Differences& d, double noise) {
  Plane r;
  r.swapped = dot(d.b, d.b) > dot(d.a, d.a);
  r.along = r.swapped ? d.b : d.a;
  const Vec other = r.swapped ? d.a : d.b;
  const double size = dot(r.along, r.along);
  if (!(size > 0x1p-600)) return r;
  r.share = dot(other, r.along) / size;
  r.across = other - r.share * r.along;
  r.across = r.across - (dot(r.across, r.along) / size) * r.along;
  const double width = dot(r.across, r.across);
  r.solvable = width > 0x1p-600;
  r.resolved = r.solvable && std::sqrt(width) > 0x1p10 * noise;
  return r;
}

bool in_domain(PairKind kind, double U, double V) {
  return U >= 0 && V >= 0 && (kind == PairKind::vertex_face ? U + V <= 1 : U <= 1 && V <= 1);
}
bool in_interior(PairKind kind, double U, double V) {
  return U > 0 && V > 0 && (kind == PairKind::vertex_face ? U + V < 1 : U < 1 && V < 1);
}

Nearest nearest(PairKind kind, const Differences& d, const Plane& plane) {
  Nearest best;
  double least = dot(d.q, d.q);
  // Also above a plane that is too thin for a normal: its boundary may be as far as its width.
  if (plane.solvable) {
    double x = 0, y = 0;
    Vec left = d.q;
    for (int round = 0; round < 2;
         ++round) {  // the second takes back what the first lost to a thin primitive
      const double dy = dot(left, plane.across) / dot(plane.across, plane.across);
      x += dot(left, plane.along) / dot(plane.along, plane.along) - dy * plane.share;
      y += dy;
      left = plane.swapped ? d.at(y, x) : d.at(x, y);
    }
    const double U = plane.swapped ? y : x, V = plane.swapped ? x : y;
    if (in_domain(kind, U, V)) {
      best = {U, V, in_interior(kind, U, V)};
      if (plane.resolved) return best;
      least = dot(left, left);
    }
  }
  struct Side {
    double U, V, dU, dV;
  };
  static constexpr Side kTriangle[] = {{0, 0, 1, 0}, {0, 0, 0, 1}, {1, 0, -1, 1}};
  static constexpr Side kSquare[] = {{0, 0, 1, 0}, {0, 0, 0, 1}, {0, 1, 1, 0}, {1, 0, 0, 1}};
  const bool triangle = kind == PairKind::vertex_face;
  const Side* sides = triangle ? kTriangle : kSquare;
  for (int i = 0; i < (triangle ? 3 : 4); ++i) {
    const Side& s = sides[i];
    const Vec w = d.at(s.U, s.V), e = s.dU * d.a + s.dV * d.b;
    const double size = dot(e, e);
    const double along = size > 0 ? std::clamp(dot(w, e) / size, 0.0, 1.0) : 0.0;
    const Nearest here{s.U + along * s.dU, s.V + along * s.dV, false};
    const Vec x = d.at(here.U, here.V);
    if (dot(x, x) < least) least = dot(x, x), best = here;
  }
  return best;
}

// To multiples of 2^-52, which moves the point by no more than u of an edge: all weights are then exact and
// sum to exactly 1 and -1, so that p1 - p2 does not depend on where in space the pair is.
Nearest rounded(PairKind kind, Nearest n) {
  n.U = (1 + n.U) - 1;
  n.V = (1 + n.V) - 1;
  if (kind == PairKind::vertex_face) n.V = std::min(n.V, 1 - n.U);
  return n;
}

std::array<double, 4> weights(PairKind kind, const Nearest& n) {
  if (kind == PairKind::vertex_face) return {1, -(1 - n.U - n.V), -n.U, -n.V};
  return {1 - n.U, n.U, -(1 - n.V), -n.V};
}

// The side of a x b that q is on at t = 0, exactly: a hair above a face is above it. 0 where it is on
// neither.
int side_at_start(PairKind kind, const Motion& motion, const std::array<int, 4>& v) {
  const double* p[4];
  for (int i = 0; i < 4; ++i) p[i] = motion.t0(v[std::size_t(i)]);
  // As in initial.cpp; for edges a x b is minus the product of their directions.
  const int sign = kind == PairKind::vertex_face ? orientation(p[2], p[3], p[0], p[1])
                                                 : -orientation(p[1], p[2], p[3], p[0]);
  return std::abs(sign) == kUnknownSide ? 0 : sign;
}

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

// One pair at one time, scaled as its corners are.
struct Contact {
  PairKind kind;
  const Motion& motion;
  const std::array<int, 4>& vertices;
  double t;
  bool parting;
  double noise;  // bound on the error of p1 - p2 and of its motion
  Plane plane;
  bool inside;
  Vec apart, motion_apart;  // p1 - p2, and how it changes over the whole step

  Vec normal() const {
    const double distance = std::sqrt(dot(apart, apart));
    // The direction of p1 - p2 is good to 2^-10 where it is so much longer than its error.
    const bool direction = distance > 0x1p10 * noise;
    const Vec across = plane.resolved ? unit(cross(unit(plane.along), unit(plane.across))) : Vec{};
    if (plane.resolved && (inside || !direction)) {
      if (const double side = side_of(across); side != 0) return side * across;
      if (inside) return wound(across);
    }
    return distance > 4 * noise ? unit(apart) : touching(across);
  }

 private:
  Vec past() const { return parting ? motion_apart : -1 * motion_apart; }

  // The sign that turns n = +- a x b, in turn, to the side that the points are on, to the exact one at t = 0,
  // and to the one that the points came from. 0: they stay in the plane.
  double side_of(const Vec& n) const {
    const double now = dot(n, apart), before = dot(n, past());
    if (std::fabs(now) > 4 * noise) return now > 0 ? 1 : -1;
    if (t == 0)
      if (const int side = side_at_start(kind, motion, vertices)) return (side > 0) != plane.swapped ? 1 : -1;
    return std::fabs(before) > 4 * noise ? (before > 0 ? 1 : -1) : 0;
  }

  // Where it came from: within the plane; or square to the longest edge, or along it, end on end. At rest the
  // winding decides, or, without one, any direction square to the edge.
  Vec touching(const Vec& across) const {
    const Vec e = plane.resolved ? Vec{} : unit(plane.along), n = past() - dot(past(), e) * e;
    if (std::sqrt(dot(n, n)) > 4 * noise) return unit(n - dot(n, e) * e);
    if (std::sqrt(dot(past(), past())) > 4 * noise) return unit(past());
    return plane.resolved ? wound(across) : square_to(e);
  }
  Vec wound(const Vec& across) const { return plane.swapped != odd(motion.axes) ? -1 * across : across; }
};

}  // namespace

ContactFrame contact_frame(PairKind kind, const Motion& motion, const std::array<int, 4>& vertices, double t,
                           bool parting) {
  const int v[4] = {vertices[0], vertices[1], vertices[2], vertices[3]};
  const Corners corners = make_corners(kind, motion, v);
  const Differences d0 = differences(kind, corners, 0), d1 = differences(kind, corners, 1);
  const Differences d{mix(d0.q, d1.q, t), mix(d0.a, d1.a, t), mix(d0.b, d1.b, t)};
  double longest = 0;
  for (const Differences* at : {&d0, &d1})
    longest = std::max({longest, std::sqrt(dot(at->a, at->a)), std::sqrt(dot(at->b, at->b))});
  // Each difference is rounded once, then mixed with 3u: 4u of its size; p1 - p2 is a sum of three such, each
  // product and sum rounded: below 12u (rho + 2 longest), and an edge is no longer than 2 rho.
  const double edge_noise = 4 * kU * longest, noise = 12 * kU * (corners.rho + 2 * longest);
  const Plane plane = plane_of(d, edge_noise);
  const Nearest near = rounded(kind, nearest(kind, d, plane));
  const Vec apart = d.at(near.U, near.V), moved = d1.at(near.U, near.V) - d0.at(near.U, near.V);
  const Vec n = Contact{kind, motion, vertices, t, parting, noise, plane, near.inside, apart, moved}.normal();
  ContactFrame r;
  r.weight = weights(kind, near);
  for (int i = 0; i < 3; ++i) r.normal[std::size_t(motion.axes[std::size_t(i)])] = n[i];
  r.gap = std::sqrt(dot(apart, apart)) * corners.unit;
  r.speed = dot(n, moved) * corners.unit;
  r.degenerate = !plane.resolved || !near.inside;
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
    pairs.vertices = reinterpret_cast<const int(*)[4]>(vertices + first);
    pairs.count = int(std::min(kAtOnce, count - first));
    of_kind(pairs, t + first, found);
    for (int i = 0; i < pairs.count; ++i) {
      const KernelFrame& f = found[i];
      const std::size_t row = first + std::size_t(i);
      ContactFrame& r = frames[row];
      if (!f.ordinary || parting[row]) {
        r = contact_frame(kind, motion, vertices[row], t[row], parting[row]);
        continue;
      }
      r = {{f.weight[0], f.weight[1], f.weight[2], f.weight[3]}, {}, f.gap, f.speed, false};
      for (std::size_t a = 0; a < 3; ++a) r.normal[std::size_t(motion.axes[a])] = f.normal[a];
    }
  }
}

}  // namespace onset
