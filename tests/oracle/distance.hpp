// The exact distance of two primitives at rest, for any ordered field Q.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "tests/oracle/arithmetic/geometry.hpp"

namespace onset::oracle {

template <class Q>
Vector<Q> nearest_to_origin(const OnSegment<Q>& s) {
  const Q ee = dot(s.e, s.e);
  if (ee == 0) return s.w;
  const Q t = std::clamp<Q>(dot(s.w, s.e) / ee, Q(0), Q(1));
  return s.w - scaled(t, s.e);
}

// The shortest q - U a - V b: above the interior where the plane's nearest point lies there, else on the
// boundary.
template <class Q>
Vector<Q> shortest_difference(const Relative<Q>& r) {
  const Vector<Q> n = cross(r.a, r.b);
  const Q nn = dot(n, n);
  if (nn != 0) {
    const Q u = dot(cross(r.q, r.b), n), v = dot(cross(r.a, r.q), n);
    const bool inside =
        u >= 0 && v >= 0 && (r.kind == PairKind::vertex_face ? u + v <= nn : u <= nn && v <= nn);
    if (inside) return scaled<Q>(dot(r.q, n) / nn, n);
  }
  Vector<Q> best = r.q;
  for (const OnSegment<Q>& s : boundary(r)) {
    const Vector<Q> d = nearest_to_origin(s);
    if (dot(d, d) < dot(best, best)) best = d;
  }
  return best;
}

template <class Q>
using Polygon = std::vector<Vector<Q>>;  // convex, in order; it may be a segment or a point

// The extreme points of {q - U a - V b}.
template <class Q>
Polygon<Q> corners(const Relative<Q>& r) {
  Polygon<Q> c{r.q, r.q - r.a};
  if (r.kind == PairKind::edge_edge) c.push_back(r.q - r.a - r.b);
  c.push_back(r.q - r.b);
  return c;
}

// The part where m.x <= d.
template <class Q>
Polygon<Q> clipped(const Polygon<Q>& polygon, const Vector<Q>& m, const Q& d) {
  Polygon<Q> result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector<Q>&x = polygon[i], &y = polygon[(i + 1) % polygon.size()];
    const Q hx = d - dot(m, x), hy = d - dot(m, y);
    if (hx >= 0) result.push_back(x);
    if ((hx > 0 && hy < 0) || (hx < 0 && hy > 0)) result.push_back(x - scaled<Q>(hx / (hx - hy), x - y));
  }
  return result;
}

// Whether the L-infinity distance is at most d: the polygon of differences meets the cube [-d, d]^3.
template <class Q>
bool within_cube(const Relative<Q>& r, const Q& d) {
  Polygon<Q> polygon = corners(r);
  for (int axis = 0; axis < 3; ++axis)
    for (int s : {-1, 1}) {
      Vector<Q> m{0, 0, 0};
      m[axis] = s;
      polygon = clipped(polygon, m, d);
    }
  return !polygon.empty();
}

// The L-infinity distance: cut along x_i = 0 and x_i = +-x_j, max |x_k| is linear on each piece, so a vertex
// has the least.
template <class Q>
Q maximum_norm_distance(const Relative<Q>& r) {
  std::vector<Polygon<Q>> pieces{corners(r)};
  const auto cut = [&](const Vector<Q>& m) {
    std::vector<Polygon<Q>> parts;
    for (const Polygon<Q>& piece : pieces)
      for (const Vector<Q>& side : {m, scaled<Q>(Q(-1), m)})
        if (Polygon<Q> part = clipped(piece, side, Q(0)); !part.empty()) parts.push_back(std::move(part));
    pieces = std::move(parts);
  };
  for (int i = 0; i < 3; ++i) {
    Vector<Q> m{0, 0, 0};
    m[i] = 1;
    cut(m);
    for (int s : {-1, 1}) {
      m[(i + 1) % 3] = s;
      cut(m);
    }
  }
  std::optional<Q> least;
  for (const Polygon<Q>& piece : pieces)
    for (const Vector<Q>& x : piece) {
      const Q size = std::max({Q(abs(x[0])), Q(abs(x[1])), Q(abs(x[2]))});
      if (!least || size < *least) least = size;
    }
  return *least;
}

}  // namespace onset::oracle
