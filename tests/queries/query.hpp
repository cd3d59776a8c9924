// One pair of either kind as plain data, and the few operations that generators need.
#pragma once

#include <array>
#include <onset/query.hpp>

namespace onset::scenes {

// Points: vertex_face: vertex, face corner 0, 1, 2; edge_edge: edge a 0, 1, edge b 0, 1.
struct Query {
  PairKind kind = PairKind::vertex_face;
  std::array<Point, 4> t0{}, t1{};

  operator VertexFaceQuery() const { return {t0, t1}; }
  operator EdgeEdgeQuery() const { return {t0, t1}; }
};

inline const char* name(PairKind kind) { return kind == PairKind::vertex_face ? "vertex-face" : "edge-edge"; }

inline QueryResult ccd(const Query& query, const Options& options = {}) {
  return query.kind == PairKind::vertex_face ? vertex_face_ccd(query, options)
                                             : edge_edge_ccd(query, options);
}

inline Point plus(Point a, const Point& b) {
  for (int i = 0; i < 3; ++i) a[i] += b[i];
  return a;
}
inline Point minus(Point a, const Point& b) {
  for (int i = 0; i < 3; ++i) a[i] -= b[i];
  return a;
}
inline Point times(double s, Point a) {
  for (double& x : a) x *= s;
  return a;
}
inline Point lerp(const Point& a, const Point& b, double t) { return plus(times(1 - t, a), times(t, b)); }

// The points that belong to the first primitive (the vertex, or edge a); the others come after them.
inline int first_body(PairKind kind) { return kind == PairKind::vertex_face ? 1 : 2; }

// Applies f(Point) -> Point to all eight points.
template <class F>
Query mapped(Query query, F&& f) {
  for (Point& p : query.t0) p = f(p);
  for (Point& p : query.t1) p = f(p);
  return query;
}
inline Query scaled(const Query& query, double s) {
  return mapped(query, [s](const Point& p) { return times(s, p); });
}
inline Query moved(const Query& query, const Point& offset) {
  return mapped(query, [&](const Point& p) { return plus(p, offset); });
}

// A 3 x 3 matrix by rows; integer matrices with small entries keep grid points exact.
using Matrix = std::array<Point, 3>;
inline Point product(const Matrix& m, const Point& p) {
  Point r;
  for (int i = 0; i < 3; ++i) r[i] = m[i][0] * p[0] + m[i][1] * p[1] + m[i][2] * p[2];
  return r;
}
inline Query transformed(const Query& query, const Matrix& m) {
  return mapped(query, [&](const Point& p) { return product(m, p); });
}

// The configuration at one time in the form that both kinds share: contact iff q = U a + V b with (U, V) in
// the triangle U, V >= 0, U + V <= 1 (vertex-face) or in the unit square (edge-edge). `base` places it in
// space.
struct Relative {
  Point q, a, b;
};
inline std::array<Point, 4> placed(PairKind kind, const Relative& r, const Point& base) {
  const Point tip = plus(base, r.a), other = plus(base, r.q);
  if (kind == PairKind::vertex_face) return {other, base, tip, plus(base, r.b)};
  return {base, tip, other, minus(other, r.b)};
}

// F(t, u, v) of the paper (eq. 1 and 2), rounded: vertex minus point of the face, point of edge a minus point
// of edge b.
inline Point separation(const Query& query, double t, double u, double v) {
  std::array<Point, 4> x;
  for (int i = 0; i < 4; ++i) x[i] = lerp(query.t0[i], query.t1[i], t);
  if (query.kind == PairKind::edge_edge) return minus(lerp(x[0], x[1], u), lerp(x[2], x[3], v));
  return minus(x[0], plus(times(1 - u - v, x[1]), plus(times(u, x[2]), times(v, x[3]))));
}

}  // namespace onset::scenes
