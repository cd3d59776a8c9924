// Integers of N 64-bit limbs in two's complement.
#pragma once

#include <cmath>
#include <cstdint>
#include <type_traits>

#include "base/assert.hpp"

namespace onset {

__extension__ using Int128 = __int128;
__extension__ using UInt128 = unsigned __int128;

// Arithmetic is modulo 2^(64 N): callers know how large results can get and choose N.
template <int N>
struct Wide {
  std::uint64_t limb[N];  // lowest first

  Wide() = default;
  bool negative() const { return limb[N - 1] >> 63; }
  // The magnitude is below 2^bits().
  int bits() const {
    const std::uint64_t sign = negative() ? ~std::uint64_t(0) : 0;
    int top = N - 1;
    while (top > 0 && limb[top] == sign) --top;
    const std::uint64_t rest = limb[top] ^ sign;
    return 64 * top + (rest == 0 ? 0 : 64 - __builtin_clzll(rest)) + (negative() ? 1 : 0);
  }
  Wide(std::int64_t x) {  // NOLINT: implicit, as between the built-in integers
    limb[0] = std::uint64_t(x);
    for (int i = 1; i < N; ++i) limb[i] = x < 0 ? ~std::uint64_t(0) : 0;
  }
  Wide(int x) : Wide(std::int64_t(x)) {}  // NOLINT
  Wide(Int128 x) {                        // NOLINT
    limb[0] = std::uint64_t(UInt128(x));
    limb[1] = std::uint64_t(UInt128(x) >> 64);
    for (int i = 2; i < N; ++i) limb[i] = x < 0 ? ~std::uint64_t(0) : 0;
  }
  template <int M, class = std::enable_if_t<(M < N)>>
  Wide(const Wide<M>& x) {  // NOLINT
    for (int i = 0; i < N; ++i) limb[i] = i < M ? x.limb[i] : x.limb[M - 1] >> 63 ? ~std::uint64_t(0) : 0;
  }

  friend Wide operator+(const Wide& a, const Wide& b) {
    Wide r;
    UInt128 sum = 0;
    for (int i = 0; i < N; ++i) {
      sum += UInt128(a.limb[i]) + b.limb[i];
      r.limb[i] = std::uint64_t(sum);
      sum >>= 64;
    }
    ONSET_ASSERT(a.negative() != b.negative() || a.negative() == r.negative());
    return r;
  }
  friend Wide operator-(const Wide& a) {
    Wide r;
    UInt128 sum = 1;
    for (int i = 0; i < N; ++i) {
      sum += ~a.limb[i];
      r.limb[i] = std::uint64_t(sum);
      sum >>= 64;
    }
    return r;
  }
  friend Wide operator-(const Wide& a, const Wide& b) {
    Wide r;
    UInt128 sum = 1;
    for (int i = 0; i < N; ++i) {
      sum += UInt128(a.limb[i]) + ~b.limb[i];
      r.limb[i] = std::uint64_t(sum);
      sum >>= 64;
    }
    ONSET_ASSERT(a.negative() == b.negative() || a.negative() == r.negative());
    return r;
  }
  friend Wide operator*(const Wide& a, const Wide& b) {
    ONSET_ASSERT(a.bits() + b.bits() <= 64 * N);
    if constexpr (N >= 6) return long_product(a, b);
    Wide r(0);
    for (int i = 0; i < N; ++i) {
      UInt128 carry = 0;
      for (int j = 0; i + j < N; ++j) {
        carry += UInt128(a.limb[i]) * b.limb[j] + r.limb[i + j];
        r.limb[i + j] = std::uint64_t(carry);
        carry >>= 64;
      }
    }
    return r;
  }
  // Numbers are mostly far smaller than their width: only limbs in use are multiplied.
  static Wide long_product(const Wide& a, const Wide& b) {
    const bool a_negative = a.limb[N - 1] >> 63, b_negative = b.limb[N - 1] >> 63;
    const Wide x = a_negative ? -a : a, y = b_negative ? -b : b;
    const int x_limbs = x.limbs_in_use(), y_limbs = y.limbs_in_use();
    Wide r(0);
    for (int i = 0; i < x_limbs; ++i) {
      const int end = y_limbs < N - i ? y_limbs : N - i;
      UInt128 carry = 0;
      for (int j = 0; j < end; ++j) {
        carry += UInt128(x.limb[i]) * y.limb[j] + r.limb[i + j];
        r.limb[i + j] = std::uint64_t(carry);
        carry >>= 64;
      }
      if (i + end < N) r.limb[i + end] = std::uint64_t(carry);
    }
    return a_negative != b_negative ? -r : r;
  }
  int limbs_in_use() const {
    int n = N;
    while (n > 0 && limb[n - 1] == 0) --n;
    return n;
  }
  // a 2^count, 0 <= count < 64 N.
  friend Wide shifted(const Wide& a, int count) {
    const int limbs = count / 64, rest = count % 64;
    Wide r;
    for (int i = N - 1; i >= 0; --i) {
      const std::uint64_t here = i >= limbs ? a.limb[i - limbs] : 0;
      const std::uint64_t below = i > limbs ? a.limb[i - limbs - 1] : 0;
      r.limb[i] = rest == 0 ? here : here << rest | below >> (64 - rest);
    }
    return r;
  }
};

inline Int128 shifted(Int128 a, int count) { return a * (Int128(1) << count); }

template <int N>
int sign_of(const Wide<N>& a) {
  if (a.limb[N - 1] >> 63) return -1;
  for (int i = 0; i < N; ++i)
    if (a.limb[i] != 0) return 1;
  return 0;
}
inline int sign_of(Int128 a) { return (a > 0) - (a < 0); }
inline int sign_of(std::int64_t a) { return (a > 0) - (a < 0); }

// Rounded, for estimates only; 64 N <= 1000.
template <int N>
double estimate(const Wide<N>& a) {
  if (sign_of(a) < 0) return -estimate(-a);
  double r = 0;
  for (int i = N - 1; i >= 0; --i) r = r * 0x1p64 + double(a.limb[i]);
  return r;
}
inline double estimate(Int128 a) { return double(a); }

}  // namespace onset
