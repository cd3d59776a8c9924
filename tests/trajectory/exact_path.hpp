// A rigid motion in 50 digits.
#pragma once

#include <Eigen/Core>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>

namespace onset::tests {

using Real = boost::multiprecision::cpp_bin_float_50;
using RealPoint = std::array<Real, 3>;

struct RigidMotion {
  Eigen::Vector3d rotation, translation, centre;
};

inline RealPoint cross(const RealPoint& a, const RealPoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Real length(const RealPoint& a) { return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); }

// c + R(t w) (p - c) + t d, by Rodrigues' formula.
inline RealPoint exact_position(const RigidMotion& m, const Real& t, const double* p) {
  RealPoint q, w, r;
  for (std::size_t a = 0; a < 3; ++a) {
    q[a] = Real(p[a]) - Real(m.centre[Eigen::Index(a)]);
    w[a] = Real(m.rotation[Eigen::Index(a)]);
  }
  const Real angle = length(w);
  if (angle > 0)
    for (Real& x : w) x /= angle;
  const RealPoint v = cross(w, q), u = cross(w, v);
  const Real s = sin(t * angle), c = 1 - cos(t * angle);
  for (std::size_t a = 0; a < 3; ++a)
    r[a] = Real(p[a]) + t * Real(m.translation[Eigen::Index(a)]) + s * v[a] + c * u[a];
  return r;
}

}  // namespace onset::tests
