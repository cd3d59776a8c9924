#include "narrowphase/initial.hpp"

#include <algorithm>
#include <cmath>

#include "narrowphase/exact/orientation.hpp"
#include "narrowphase/vec.hpp"

namespace onset {
namespace {

constexpr int kHalvings = 24;
constexpr double kMostHalved = 0x1p23;  // the shortest length that `latest` tries is one over this
static_assert(kMostHalved == double(1 << (kHalvings - 1)),
              "what `goes_through` refutes is what `latest` tries");

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

// Says whether no direction parts the pair at any time, since it touches within its primitives, up to noise,
// and a corner goes through to the other side: part_from_noise then finds nothing, whatever it tries. False
// where that is not plain.
//
// n would have n.h_k >= -20u rho for the corners h_k at t = 0 and n.c_k > 57u rho for those at a time s
// (16 and 64, less 3.2u rho of a product, and 3u rho where corners are mixed). Weights b_k > 0 of sum 1 bring
// the h_k to f: b_k n.h_k = n.f - sum_j b_j n.h_j, so that |n.h_k| <= m = 1.01 (|f| + 20u rho) / b with b the
// least weight. So n is nearly square to two edges e_i of the hull, and what it has square to w, the plane's
// normal, is at most r = (2m + 4u rho + k) (|e_1| + |e_2|) / |w.(e_1 x e_2)| for k the largest |w.e_i|. With
// r <= 1/4 the rest of n is between 0.9 w and 1.01 w, to the side where the pair is. Of a corner g at t = 1
// n.g > -m / s is wanted: s >= 2^-23, and where w.g to that side is below -1.2 (2^23 m + r |g|) it is not so.
// Each length and product below errs by less than 16u of what it is made of.
bool goes_through(const InitialCase& c, const Hull& here, const Side& side) {
  if (side.sign != 1 && side.sign != -1) return false;
  const bool edges = here.count == 4;
  const Vec &w = side.normal, e1 = here.c[edges ? 2 : 1] - here.c[0], e2 = here.c[edges ? 1 : 2] - here.c[0];
  const double aa = dot(e1, e1), ab = dot(e1, e2), bb = dot(e2, e2), det = aa * bb - ab * ab;
  if (!(det > 0)) return false;
  const double p = dot(e1, here.c[0]), q = dot(e2, here.c[0]);
  const double u = (ab * q - bb * p) / det, v = (ab * p - aa * q) / det;
  const double of_edges[4] = {(1 - u) * (1 - v), (1 - u) * v, u * (1 - v), u * v};
  const double of_face[4] = {1 - u - v, u, v, 1};
  const double* weight = edges ? of_edges : of_face;
  const double least = *std::min_element(weight, weight + here.count);
  if (!(least > 0)) return false;
  Vec f{};
  for (int k = 0; k < here.count; ++k) f = f + weight[k] * here.c[k];
  const double urho = kU * c.corners.rho, len1 = std::sqrt(aa), len2 = std::sqrt(bb);
  const double m = 1.01 * (std::sqrt(dot(f, f)) + 36 * urho) / least;
  const double across = std::max(std::fabs(dot(w, e1)), std::fabs(dot(w, e2))) + 16 * urho;
  const double area = std::fabs(dot(w, cross(e1, e2))) - 64 * kU * len1 * len2;
  if (!(area > 0)) return false;
  const double r = (2 * m + 4 * urho + across) * (len1 + len2) / area;
  if (!(r <= 0.25)) return false;
  for (int k = 0; k < here.count; ++k) {
    const Vec g = vec(c.corners.c[1][k]);
    if (side.sign * dot(w, g) < -(1.2 * (kMostHalved * m + r * std::sqrt(dot(g, g))) + 32 * urho))
      return true;
  }
  return false;
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
  if (goes_through(c, here, side)) return 0;
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

bool plainly_goes_through(const InitialCase& c) {
  return goes_through(c, Hull(c.corners, 0), side_at_start(c));
}

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
