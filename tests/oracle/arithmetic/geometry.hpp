// Vectors over any exact type, and the form of a pair that both kinds share.
#pragma once

#include <array>
#include <onset/result.hpp>
#include <vector>

namespace onset::oracle {

template <class T>
using Vector = std::array<T, 3>;

template <class T>
Vector<T> operator-(const Vector<T>& a, const Vector<T>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <class T>
Vector<T> scaled(const T& s, const Vector<T>& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
template <class T>
T dot(const Vector<T>& a, const Vector<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class T>
T cross(const Vector<T>& a, const Vector<T>& b, int axis) {
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  return a[i] * b[j] - a[j] * b[i];
}
template <class T>
Vector<T> cross(const Vector<T>& a, const Vector<T>& b) {
  return {cross(a, b, 0), cross(a, b, 1), cross(a, b, 2)};
}

// The primitives touch iff q = U a + V b with U, V >= 0 and U + V <= 1 (vertex-face), or U, V in [0, 1]
// (edge-edge).
template <class T>
struct Relative {
  PairKind kind;
  Vector<T> q, a, b;
};
template <class T>
Relative<T> relative(PairKind kind, const std::array<Vector<T>, 4>& x) {
  if (kind == PairKind::vertex_face) return {kind, x[0] - x[1], x[2] - x[1], x[3] - x[1]};
  return {kind, x[2] - x[0], x[1] - x[0], x[2] - x[3]};
}

// The boundary of the primitive {U a + V b}: the point w on the segment from 0 to e. Where a and b are
// parallel it is the whole primitive.
template <class T>
struct OnSegment {
  Vector<T> w, e;
};
template <class T>
std::vector<OnSegment<T>> boundary(const Relative<T>& r) {
  if (r.kind == PairKind::vertex_face) return {{r.q, r.a}, {r.q, r.b}, {r.q - r.a, r.b - r.a}};
  return {{r.q, r.a}, {r.q, r.b}, {r.q - r.b, r.a}, {r.q - r.a, r.b}};
}

}  // namespace onset::oracle
