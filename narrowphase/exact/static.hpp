// Whether primitives that are coplanar at one time touch then: exact, for integers C with products in M.
#pragma once

#include "narrowphase/exact/pair.hpp"
#include "narrowphase/exact/wide.hpp"

namespace onset {

template <class M, class C>
std::array<M, 3> exact_cross(const std::array<C, 3>& u, const std::array<C, 3>& v) {
  return {M(u[1]) * M(v[2]) - M(u[2]) * M(v[1]), M(u[2]) * M(v[0]) - M(u[0]) * M(v[2]),
          M(u[0]) * M(v[1]) - M(u[1]) * M(v[0])};
}
template <class M, class C>
M exact_dot(const std::array<C, 3>& u, const std::array<C, 3>& v) {
  return M(u[0]) * M(v[0]) + M(u[1]) * M(v[1]) + M(u[2]) * M(v[2]);
}

template <class M, class C>
bool on_segment(const PointAndSegment<C>& s) {
  for (const M& x : exact_cross<M>(s.w, s.e))
    if (sign_of(x) != 0) return false;
  return sign_of(exact_dot<M>(s.w, difference(s.e, s.w))) >= 0;
}

// Given q.(a x b) = 0. With n = a x b != 0 on axis k, U n = q x b and V n = a x q hold on that axis alone
// (docs/theory.md, L38). For coordinates of q, a, b below 2^c, M holds 2^(2c + 3).
template <class M, class C>
bool coplanar_touch(PairKind kind, const RelativeVectors<C>& r) {
  const std::array<M, 3> n = exact_cross<M>(r.a, r.b), u = exact_cross<M>(r.q, r.b),
                         v = exact_cross<M>(r.a, r.q);
  for (int k = 0; k < 3; ++k) {
    const int s = sign_of(n[k]);
    if (s == 0) continue;
    if (s * sign_of(u[k]) < 0 || s * sign_of(v[k]) < 0) return false;
    if (kind != PairKind::edge_edge) return s * sign_of(n[k] - u[k] - v[k]) >= 0;
    return s * sign_of(n[k] - u[k]) >= 0 && s * sign_of(n[k] - v[k]) >= 0;
  }
  PointAndSegment<C> segments[4];
  const int count = boundary_of(kind, r, segments);
  for (int i = 0; i < count; ++i)
    if (on_segment<M>(segments[i])) return true;
  return false;
}

}  // namespace onset
