// Three doubles with the few operations that scalar certificates need. Sums run in the kernels' order.
#pragma once

#include <cmath>

namespace onset {

struct Vec {
  double x[3];
  double operator[](int a) const { return x[a]; }
  double& operator[](int a) { return x[a]; }
};
inline Vec operator+(const Vec& a, const Vec& b) { return {{a[0] + b[0], a[1] + b[1], a[2] + b[2]}}; }
inline Vec operator-(const Vec& a, const Vec& b) { return {{a[0] - b[0], a[1] - b[1], a[2] - b[2]}}; }
inline Vec operator*(double s, const Vec& a) { return {{s * a[0], s * a[1], s * a[2]}}; }
inline double dot(const Vec& a, const Vec& b) { return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]; }
inline Vec cross(const Vec& a, const Vec& b) {
  return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
}
inline Vec vec(const double (&p)[3]) { return {{p[0], p[1], p[2]}}; }
// a / |a|, or 0.
inline Vec unit(const Vec& a) {
  const double n = std::sqrt(dot(a, a));
  return n > 0x1p-300 ? (1 / n) * a : Vec{};
}

}  // namespace onset
