// Numbers as unevaluated sums of two doubles: about 106 bits, by error-free transformations.
//
// Sums are right to 3 u^2 and products to 8 u^2 (Joldes, Muller and Popescu 2017), quotients and square roots
// to 20 u^2 (docs/theory.md, §16.2), where nothing over- or underflows: callers scale to near 1, and what is
// lost below 2^-900 does not count.
#pragma once

#include <cmath>

namespace onset {

struct DoubleDouble {
  double hi = 0, lo = 0;

  DoubleDouble() = default;
  DoubleDouble(double x) : hi(x) {}  // NOLINT: implicit, as between the built-in numbers
  DoubleDouble(double h, double l) : hi(h), lo(l) {}
};

// Adds without error; quick: |a| >= |b|, or a = 0.
inline DoubleDouble two_sum(double a, double b) {
  const double s = a + b, part = s - a;
  return {s, (a - (s - part)) + (b - part)};
}
inline DoubleDouble quick_two_sum(double a, double b) {
  const double s = a + b;
  return {s, b - (s - a)};
}
inline DoubleDouble two_difference(double a, double b) { return two_sum(a, -b); }

// Multiplies without error, by Dekker's splitting. The rounded product must not be fused into a sum, as its
// error is wanted; all others here are exact, fused or not.
inline DoubleDouble two_product(double a, double b) {
  const volatile double rounded = a * b;
  const double p = rounded, a1 = 0x8000001p0 * a, b1 = 0x8000001p0 * b;
  const double ah = a1 - (a1 - a), al = a - ah, bh = b1 - (b1 - b), bl = b - bh;
  return {p, ((ah * bh - p) + ah * bl + al * bh) + al * bl};
}

inline DoubleDouble operator-(const DoubleDouble& a) { return {-a.hi, -a.lo}; }
inline DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble s = two_sum(a.hi, b.hi), t = two_sum(a.lo, b.lo);
  const DoubleDouble v = quick_two_sum(s.hi, s.lo + t.hi);
  return quick_two_sum(v.hi, t.lo + v.lo);
}
inline DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + -b; }
inline DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble p = two_product(a.hi, b.hi);
  return quick_two_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}
inline DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
  const double first = a.hi / b.hi;
  const DoubleDouble rest = a - DoubleDouble(first) * b;
  return quick_two_sum(first, rest.hi / b.hi);
}
inline DoubleDouble sqrt(const DoubleDouble& a) {
  if (!(a.hi > 0)) return 0.0;
  const double root = std::sqrt(a.hi);
  const DoubleDouble rest = a - two_product(root, root);
  return quick_two_sum(root, rest.hi / (2 * root));
}
inline bool operator<(const DoubleDouble& a, const DoubleDouble& b) {
  return a.hi < b.hi || (a.hi == b.hi && a.lo < b.lo);
}
inline bool operator>(const DoubleDouble& a, const DoubleDouble& b) { return b < a; }

// By a power of two.
inline DoubleDouble scaled(const DoubleDouble& a, double power) { return {a.hi * power, a.lo * power}; }

}  // namespace onset
