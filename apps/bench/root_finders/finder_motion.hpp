// Both kinds of pairs in one form: contact iff q(t) = U a(t) + V b(t) with (U, V) in the triangle U, V >= 0,
// U + V <= 1 (vertex-face) or in the unit square (edge-edge).
#pragma once

#include <array>
#include <onset/result.hpp>

#include "files/queries/query_file.hpp"

namespace app {

template <class Real>
using Vector = std::array<Real, 3>;

template <class Real>
Vector<Real> operator-(const Vector<Real>& x, const Vector<Real>& y) {
  return {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
}
template <class Real>
Vector<Real> cross(const Vector<Real>& x, const Vector<Real>& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}
template <class Real>
Real dot(const Vector<Real>& x, const Vector<Real>& y) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

template <class Real>
struct Relative {
  Vector<Real> q, a, b;
};

// From the four points at one time, whose differences are rounded as Real rounds.
template <class Real>
Relative<Real> relative(onset::PairKind kind, const std::array<Vector<Real>, 4>& x) {
  if (kind == onset::PairKind::vertex_face) return {x[0] - x[1], x[2] - x[1], x[3] - x[1]};
  return {x[2] - x[0], x[1] - x[0], x[2] - x[3]};
}

template <class Real>
std::array<Vector<Real>, 4> positions(const TruthQuery& query, const Real& t) {
  std::array<Vector<Real>, 4> x;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      x[i][k] = Real(query.t0[i][k]) + t * (Real(query.t1[i][k]) - Real(query.t0[i][k]));
  return x;
}

}  // namespace app
