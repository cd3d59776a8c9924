#include "narrowphase/initial.hpp"

#include <algorithm>
#include <cmath>

#include "narrowphase/exact/orientation.hpp"
#include "narrowphase/vec.hpp"

namespace onset {
namespace {

constexpr int kHalvings = 24;

struct Hull {
  int count;
  Vec c[4];
  Hull(const Corners& corners, double t) : count(corners.count) {
    double at[4][3];
    corners.at(t, at);
    for (int k = 0; k < count; ++k) c[k] = vec(at[k]);
  }
  double least(const Vec& n) const {
    double r = dot(n, c[0]);
    for (int k = 1; k < count; ++k) r = std::min(r, dot(n, c[k]));
    return r;
  }
};

bool same_at_both_ends(const Corners& corners) {
  for (int k = 0; k < corners.count; ++k)
    for (int a = 0; a < 3; ++a)
      if (corners.c[0][k][a] != corners.c[1][k][a]) return false;
  return true;
}

// The plane of the face or both edges' directions at t = 0, and the pair's exact side of it.
struct Side {
  Vec normal;
  int sign;  // of normal . c_k
  bool allows(const Vec& n) const {
    const double s = dot(n, normal);
    if (std::fabs(s) < 1e-9) return true;
    return sign == 0 || (sign != kUnknownSide && (s > 0) == (sign > 0));
  }
};
Side side_at_start(const InitialCase& c) {
  const Corners& q = c.corners;
  const auto edge = [&](int i) { return vec(q.e[0][i]); };
  const double* p[4];
  for (int i = 0; i < 4; ++i) p[i] = c.pairs.x + std::ptrdiff_t(c.pairs.vertices[c.row][i]) * kMotionStride;
  // Vertex-face: (v1 - v0) x (v2 - v1) . (p - v0), edge-edge: (a1 - a0) x (b1 - b0) . (a0 - b0).
  const int sign = c.kind != PairKind::edge_edge ? orientation(p[2], p[3], p[0], p[1])
                                                 : orientation(p[1], p[2], p[3], p[0]);
  return {unit(cross(edge(0), edge(1))), sign};
}

// Returns a direction n with n.c >= -noise at both times and > 0 at the second, the mean of that cone's
// extreme rays; 0 where there is none.
Vec dividing_direction(const Hull& from, const Hull& to, const Side& side, double noise) {
  Vec p[8];
  int count = 0;
  for (int k = 0; k < from.count; ++k) p[count++] = unit(from.c[k]), p[count++] = unit(to.c[k]);
  Vec total{}, widest{};
  double widest_size = 0;
  const auto consider = [&](const Vec& ray) {
    for (const double s : {1.0, -1.0}) {
      const Vec n = unit(s * ray);
      if (from.least(n) < -noise || to.least(n) < -noise || !side.allows(n)) continue;
      total = total + n;
    }
  };
  for (int i = 0; i < count; ++i) {
    consider(p[i]);
    for (int j = 0; j < i; ++j) {
      const Vec ray = cross(p[i], p[j]);
      if (dot(ray, ray) > widest_size) widest_size = dot(ray, ray), widest = ray;
      if (dot(ray, ray) > 1e-24) consider(ray);
    }
  }
  for (int i = 0; i < count; ++i) consider(cross(widest, p[i]));  // the cone's rays when all lie in one plane
  return unit(total);
}

// Returns the latest time found until which the pair parts along a direction chosen for it; t for none.
template <class Parts>
double latest(double t, Parts&& parts) {
  double length = 1 - t;
  for (int i = 0; i < kHalvings; ++i, length *= 0.5) {
    const double tb = i == 0 ? 1 : t + length;
    if (tb > t && parts(tb)) return tb;
  }
  return t;
}

// Parts a pair within noise of touching along a direction that divides it, if it never touches before,
// exactly.
double part_from_noise(const InitialCase& c, const Hull& here, double noise, Vec& n) {
  const Side side = side_at_start(c);
  const double reached = latest(0, [&](double tb) {
    const Hull there(c.corners, tb);
    n = dividing_direction(here, there, side, noise);
    return here.least(n) >= -noise && there.least(n) > 4 * noise && side.allows(n);
  });
  if (reached == 0 || c.exact == nullptr) return reached;
  const auto touch = exact_first_contact(*c.exact);
  return touch && touch->lo <= reached ? 0 : reached;
}

}  // namespace

Parting find_parting(const InitialCase& c) {
  Parting r;
  if (same_at_both_ends(c.corners)) {
    r.t = 1;
    return r;
  }
  const double noise = 16 * kU * c.corners.rho;
  double start = -INFINITY;  // what must not be lost
  for (int rounds = 0; rounds < 64 && r.t < 1; ++rounds) {
    const Hull here(c.corners, r.t);
    Vec n = c.direction(r.t);
    const double before = here.least(n);
    if (r.t == 0) start = before;
    double reached = r.t;
    if (before > 4 * noise) {
      const double least = std::max(before, start);
      reached = latest(r.t, [&](double tb) { return Hull(c.corners, tb).least(n) >= least; });
    } else if (r.t == 0) {
      reached = part_from_noise(c, here, noise, n);
    }
    if (reached == r.t) return r;
    r.t = reached;
    // This takes off 8u rho where up to 15u rho is due, and in the maximum norm does not divide by |n|_1:
    // that is harmless, as later certificates prove everything again.
    r.excess = Hull(c.corners, r.t).least(n) - 8 * kU * c.corners.rho - c.separation;
    r.apart = r.excess > 0;
    if (r.apart) return r;
  }
  return r;
}

}  // namespace onset
