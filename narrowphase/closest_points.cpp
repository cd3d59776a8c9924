#include "narrowphase/closest_points.hpp"

#include <algorithm>
#include <cmath>

#include "narrowphase/vec.hpp"

namespace onset {
namespace {

// The differences first - second of a pair, scaled by a power of two so that the largest component is in
// [1, 2), or all are 0. The relative error of a component is u.
struct Differences {
  Vec c[4];
  int count;
  double unit;
};

Vec difference(const double* p, const double* q, double scale) {
  return {{(p[0] - q[0]) * scale, (p[1] - q[1]) * scale, (p[2] - q[2]) * scale}};
}

Differences differences(PairKind kind, const double* const (&x)[4], double scale) {
  Differences d{{}, kind == PairKind::vertex_face ? 3 : 4, 1};
  for (int k = 0; k < d.count; ++k)
    d.c[k] = d.count == 3 ? difference(x[0], x[1 + k], scale) : difference(x[k / 2], x[2 + k % 2], scale);
  return d;
}

double largest_component(const Differences& d) {
  double r = 0;
  for (int k = 0; k < d.count; ++k)
    for (const double c : d.c[k].x) r = std::max(r, std::fabs(c));
  return r;
}

// A point of the polygon of differences by the weights of the four vertices.
struct Candidate {
  double weights[4];
  Vec w;
  double ww;
};

class Search {
 public:
  Search(PairKind kind, const double* const (&x)[4]) : kind_(kind), d_(differences(kind, x, 1)) {
    const double size = largest_component(d_);
    const double unit = size > 0 ? std::ldexp(1.0, std::max(std::ilogb(size), -1021)) : 1;
    d_ = differences(kind, x, 1 / unit);
    d_.unit = unit;
    const int ends[2][6] = {{1, 2, 2, 3, 3, 1}, {0, 1, 2, 3, 0, 0}};
    const int(&e)[6] = ends[kind == PairKind::edge_edge];
    for (int i = 0; i < 3; ++i) edges_[i] = difference(x[e[2 * i + 1]], x[e[2 * i]], 1 / unit);
  }

  ClosestPoints solve() {
    if (kind_ == PairKind::vertex_face)
      triangle();
    else
      edges();
    ClosestPoints r{{}, std::sqrt(best_.ww) * d_.unit, 0, 0, {}};
    for (int i = 0; i < 4; ++i) r.weights[i] = best_.weights[i] + 0.0;  // no -0
    r.lower = std::max(lower_bound(best_.w), lower_bound(normal_)) * d_.unit - 0x1p-1074;
    const Vec w = unit(lower_bound(best_.w) > lower_bound(normal_) ? best_.w : normal_);
    for (int a = 0; a < 3; ++a) r.direction[a] = w[a];
    r.upper = r.distance * (1 + 0x1p-49) + 0x1p-48 * d_.unit * 2;
    return r;
  }

 private:
  // The difference of the points that the weights stand for: sum of first[i] second[j] c_ij.
  Vec at(const double (&weights)[4]) const {
    Vec w{};
    for (int k = 0; k < d_.count; ++k)
      w = w + (d_.count == 3 ? -weights[1 + k] : weights[k / 2] * -weights[2 + k % 2]) * d_.c[k];
    return w;
  }
  void offer(double a, double b, double c, double d) {
    Candidate here{{a, b, c, d}, {}, 0};
    here.w = at(here.weights);
    here.ww = dot(here.w, here.w);
    if (!found_ || here.ww < best_.ww) best_ = here;
    found_ = true;
  }

  // The share s of the way along `edge` at which c0 + s (c1 - c0) is closest to the origin; c1 - c0 = sign
  // edge.
  static double along(const Vec& c0, const Vec& edge, double sign) {
    const double ee = dot(edge, edge);
    return ee > 0 ? std::clamp(-sign * dot(c0, edge) / ee, 0.0, 1.0) : 0;
  }

  void triangle() {
    for (int i = 0; i < 3; ++i) {  // from corner i to corner i + 1 the difference falls by the edge
      const double s = along(d_.c[i], edges_[i], -1);
      double w[3] = {0, 0, 0};
      w[i] = 1 - s, w[(i + 1) % 3] = s;
      offer(1, -w[0], -w[1], -w[2]);
    }
    const Vec q = d_.c[0], a = edges_[0], b = -1 * edges_[2], n = cross(a, b);
    const double nn = dot(n, n), u = dot(cross(q, b), n), v = dot(cross(a, q), n);
    if (!(nn > 0 && u > 0 && v > 0 && u + v < nn)) return;
    normal_ = dot(n, q) < 0 ? -1 * n : n;
    const double fu = u / nn, fv = v / nn;
    offer(1, -std::max(0.0, 1 - fu - fv), -fu, -fv);
  }

  void edges() {
    for (int i = 0; i < 2; ++i) {
      // End i of edge a against edge b: the difference falls along b; end i of b against a: it grows.
      const double t = along(d_.c[2 * i], edges_[1], -1), s = along(d_.c[i], edges_[0], 1);
      offer(i == 0, i == 1, -(1 - t), -t);
      offer(1 - s, s, -(i == 0), -(i == 1));
    }
    const Vec q = -1 * d_.c[0], a = edges_[0], b = edges_[1], n = cross(a, b);
    const double nn = dot(n, n), u = dot(cross(q, b), n), v = dot(cross(q, a), n);
    if (!(nn > 0 && u > 0 && v > 0 && u < nn && v < nn)) return;
    normal_ = dot(n, q) > 0 ? -1 * n : n;
    const double fu = u / nn, fv = v / nn;
    offer(1 - fu, fu, -(1 - fv), -fv);
  }

  // For any direction n the polygon of differences, hence the distance, stays beyond min_k n.c_k / |n|. Each
  // product errs by 3u |n||c_k|, its c_k by u |c_k|: below 5u |n| rho with rho = max |c_k| and second order;
  // the norm and the quotient by 4u of the result, itself below rho: 16u rho = 2^-49 rho covers all, with
  // |n| brought into [1, 4) so that nothing but 2^-1000 is lost to underflow.
  double lower_bound(Vec n) const {
    const double size = std::max({std::fabs(n[0]), std::fabs(n[1]), std::fabs(n[2])});
    if (!(size > 0x1p-1000)) return -INFINITY;
    n = std::ldexp(1.0, -std::ilogb(size)) * n;
    double least = INFINITY, rho2 = 0;
    for (int k = 0; k < d_.count; ++k) {
      least = std::min(least, dot(n, d_.c[k]));
      rho2 = std::max(rho2, dot(d_.c[k], d_.c[k]));
    }
    return least / std::sqrt(dot(n, n)) - (0x1p-49 * std::sqrt(rho2) + 0x1p-1000);
  }

  PairKind kind_;
  Differences d_;
  Vec edges_[3];
  Vec normal_{};  // towards the differences, where the closest point is inside
  Candidate best_{};
  bool found_ = false;
};

}  // namespace

ClosestPoints closest_points(PairKind kind, const double* const (&x)[4]) { return Search(kind, x).solve(); }

}  // namespace onset
