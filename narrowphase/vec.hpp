// Three doubles (or double-doubles). Sums run in the kernels' order.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/unit_roundoff.hpp"

namespace onset {

template <class T>
struct VecOf {
  using Number = T;
  T x[3];
  const T& operator[](int a) const { return x[a]; }
  T& operator[](int a) { return x[a]; }
};
using Vec = VecOf<double>;

template <class T>
VecOf<T> operator+(const VecOf<T>& a, const VecOf<T>& b) {
  return {{a[0] + b[0], a[1] + b[1], a[2] + b[2]}};
}
template <class T>
VecOf<T> operator-(const VecOf<T>& a, const VecOf<T>& b) {
  return {{a[0] - b[0], a[1] - b[1], a[2] - b[2]}};
}
template <class T>
VecOf<T> operator*(const typename VecOf<T>::Number& s, const VecOf<T>& a) {
  return {{s * a[0], s * a[1], s * a[2]}};
}
template <class T>
T dot(const VecOf<T>& a, const VecOf<T>& b) {
  return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}
template <class T>
VecOf<T> cross(const VecOf<T>& a, const VecOf<T>& b) {
  return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
}
inline Vec vec(const double (&p)[3]) { return {{p[0], p[1], p[2]}}; }
inline double largest_component(const Vec& a) {
  return std::max(std::max(std::fabs(a[0]), std::fabs(a[1])), std::fabs(a[2]));
}
inline double sum_of_magnitudes(const Vec& a) { return std::fabs(a[0]) + std::fabs(a[1]) + std::fabs(a[2]); }
// a / |a|, or 0.
inline Vec unit(const Vec& a) {
  const double n = std::sqrt(dot(a, a));
  return n > 0x1p-300 ? (1 / n) * a : Vec{};
}

}  // namespace onset
