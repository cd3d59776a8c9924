// From a root between two dyadic times to the adjacent doubles around it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "narrowphase/exact/wide.hpp"

namespace onset {

struct DoubleBracket {
  double lo = 0, hi = 0;  // adjacent doubles, or the same one
};

inline std::uint64_t double_bits(double x) {
  std::uint64_t b;
  std::memcpy(&b, &x, sizeof b);
  return b;
}
inline double double_from_bits(std::uint64_t b) {
  double x;
  std::memcpy(&x, &b, sizeof x);
  return x;
}

// t = numerator / 2^exponent in lowest terms, for t in [0, 1].
struct Dyadic {
  std::int64_t numerator;
  int exponent;
};
inline Dyadic to_dyadic(double t) {
  if (t == 0) return {0, 0};
  int e;
  std::int64_t m = std::int64_t(std::ldexp(std::frexp(t, &e), 53));
  e = 53 - e;
  while (m % 2 == 0) m /= 2, --e;
  return e < 0 ? Dyadic{m << -e, 0} : Dyadic{m, e};
}

// Approximates the root in (0, 1) of the cubic with Bernstein coefficients c; the middle, where the signs of
// its ends do not differ or have been rounded away.
inline double approximate_root(const double (&c)[4]) {
  if ((c[0] < 0) == (c[3] < 0)) return 0.5;
  const double c1 = 3 * (c[1] - c[0]), c2 = 3 * (c[0] - 2 * c[1] + c[2]),
               c3 = (c[3] - c[0]) - 3 * (c[2] - c[1]);
  double lo = 0, hi = 1, s = c[0] / (c[0] - c[3]);
  for (int i = 0; i < 8; ++i) {
    const double f = ((c3 * s + c2) * s + c1) * s + c[0];
    ((f < 0) == (c[0] < 0) ? lo : hi) = s;
    const double slope = (3 * c3 * s + 2 * c2) * s + c1;
    const double next = slope != 0 ? s - f / slope : lo;
    s = next > lo && next < hi ? next : 0.5 * (lo + hi);
  }
  return s;
}

// Narrows (lo, hi) around one root to adjacent doubles. sign(t) is exact, in units of that at lo: it turns
// negative at the root. The stride doubles, so a good guess takes three signs.
template <class Sign>
DoubleBracket adjacent_doubles(double lo, double hi, double guess, Sign&& sign) {
  std::uint64_t a = double_bits(lo), b = double_bits(hi), stride = 1;
  std::uint64_t next = double_bits(std::clamp(guess, lo, hi));
  while (a + 1 < b) {
    next = std::clamp(next, a + 1, b - 1);
    const int s = sign(double_from_bits(next));
    if (s == 0) return {double_from_bits(next), double_from_bits(next)};
    (s > 0 ? a : b) = next;
    const std::uint64_t half = (b - a) / 2;
    next = stride < half ? (s > 0 ? a + stride : b - stride) : a + half;
    stride = std::min(2 * stride, half);
  }
  return {double_from_bits(a), double_from_bits(b)};
}

}  // namespace onset
