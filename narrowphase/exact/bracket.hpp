// The adjacent doubles around an isolated root of a cubic with integer coefficients of fixed width.
#pragma once

#include <optional>

#include "narrowphase/exact/root.hpp"

namespace onset {

// The sign at a time of a cubic with Bernstein coefficients below 2^bits on [0, 1]: as a form in x and y =
// 2^e - x it is below 2^(bits + 3e + 3) (docs/theory.md, L37).
template <int N, class T>
struct CubicSign {
  const T (&f)[4];
  int bits;
  bool fits = true;

  int at(double t) { return sign_of(value(to_dyadic(t))); }
  double estimate_at(double t) {
    const Dyadic d = to_dyadic(t);
    return std::ldexp(estimate(value(d)), -3 * d.exponent);
  }

 private:
  using E = Wide<N>;
  E value(const Dyadic& d) {
    if (bits + 3 * d.exponent + 4 > 64 * N) {
      fits = false;
      return E(0);
    }
    const E x(d.numerator), y = shifted(E(1), d.exponent) - x, yy = y * y;
    const E f1 = E(f[1]), f2 = E(f[2]), three_f1 = f1 + f1 + f1, three_f2 = f2 + f2 + f2;
    return ((E(f[3]) * x + three_f2 * y) * x + three_f1 * yy) * x + E(f[0]) * (yy * y);
  }
};

// Finds the adjacent doubles around f's one root between k / 2^depth and (k + 1) / 2^depth, depth < 50, where
// its signs differ. None: it does not fit.
template <int N, class T>
std::optional<DoubleBracket> bracket_of(const T (&f)[4], int bits, std::uint64_t k, int depth) {
  const double width = std::ldexp(1.0, -depth), lo = double(k) * width, hi = lo + width;
  CubicSign<N, T> sign{f, bits};
  double c[4];
  for (int i = 0; i < 4; ++i) c[i] = estimate(f[i]);
  for (int level = depth - 1; level >= 0; --level) {
    const double a = 0.5 * (c[0] + c[1]), m = 0.5 * (c[1] + c[2]), b = 0.5 * (c[2] + c[3]);
    const double am = 0.5 * (a + m), mb = 0.5 * (m + b), middle = 0.5 * (am + mb);
    if (k >> level & 1)
      c[0] = middle, c[1] = mb, c[2] = b;
    else
      c[1] = a, c[2] = am, c[3] = middle;
  }
  const double s = approximate_root(c);
  const double slope =
      3 * (((c[1] - c[0]) * (1 - s) + 2 * (c[2] - c[1]) * s) * (1 - s) + (c[3] - c[2]) * s * s) / width;
  double t = lo + s * width;
  // Another step with the exact value leads to within an ulp or two of the root.
  if (const double next = t - sign.estimate_at(t) / slope; next > lo && next < hi) t = next;
  const int before = lo == 0 ? sign_of(f[0]) : sign.at(lo);
  const DoubleBracket r = adjacent_doubles(lo, hi, t, [&](double at) { return before * sign.at(at); });
  if (!sign.fits) return std::nullopt;
  return r;
}

}  // namespace onset
