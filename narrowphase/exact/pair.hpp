// A pair's positions as integers, and the form that both kinds share.
#pragma once

#include <algorithm>
#include <array>
#include <iterator>

#include "onset/result.hpp"
#include "scene/motion/motion.hpp"

namespace onset {

// Three finite doubles a point: v, f0, f1, f2 or a0, a1, b0, b1 or v, e0, e1, e1 at both ends of the motion.
struct ExactPair {
  PairKind kind;
  const double* t0[4];
  const double* t1[4];
};

template <class Vertices>
ExactPair exact_pair(PairKind kind, const Motion& motion, const Vertices& vertices) {
  ExactPair r{kind, {}, {}};
  for (int i = 0; i < 4; ++i) {
    const int v = *(std::begin(vertices) + i);
    r.t0[i] = motion.t0(v), r.t1[i] = motion.t1(v);
  }
  return r;
}

inline bool rests(const ExactPair& pair) {
  for (int i = 0; i < 4; ++i)
    if (!std::equal(pair.t0[i], pair.t0[i] + 3, pair.t1[i])) return false;
  return true;
}

enum class Answer { no, yes, unknown };

// The pair touches iff q = U a + V b with U, V >= 0, U + V <= 1 (vertex-face) or U, V in [0, 1] (edge-edge).
// In the plane b = a is the edge, which is all of the boundary, and third components are 0.
template <class C>
struct RelativeVectors {
  std::array<C, 3> q, a, b;
};

template <class C>
std::array<C, 3> difference(const std::array<C, 3>& x, const std::array<C, 3>& y) {
  return {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
}

template <class C>
RelativeVectors<C> relative_vectors(PairKind kind, const std::array<std::array<C, 3>, 4>& x) {
  if (kind != PairKind::edge_edge)
    return {difference(x[0], x[1]), difference(x[2], x[1]), difference(x[3], x[1])};
  return {difference(x[2], x[0]), difference(x[1], x[0]), difference(x[2], x[3])};
}

// A segment of the boundary of {U a + V b}, which q is on iff w x e = 0 and w.(e - w) >= 0 (docs/theory.md,
// L39). Where a and b are parallel the boundary is all there is.
template <class C>
struct PointAndSegment {
  std::array<C, 3> w, e;
};
template <class C>
int boundary_of(PairKind kind, const RelativeVectors<C>& r, PointAndSegment<C> (&out)[4]) {
  out[0] = {r.q, r.a};
  if (kind == PairKind::vertex_edge) return 1;
  out[1] = {r.q, r.b};
  if (kind != PairKind::edge_edge) {
    out[2] = {difference(r.q, r.a), difference(r.b, r.a)};
    return 3;
  }
  out[2] = {difference(r.q, r.b), r.a};
  out[3] = {difference(r.q, r.a), r.b};
  return 4;
}

}  // namespace onset
