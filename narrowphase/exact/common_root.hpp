// Is a quadratic zero at a cubic's root? In integers of fixed width.
//
// With t = x / (x + y) both are forms in (x : y): f = sum a_i x^i y^(3 - i), g = sum b_i x^i y^(2 - i). Where
// b_2 != 0 the remainder b_2^2 f mod g = r_1 x + r_0 y vanishes at every common root: if it is not zero
// throughout, the only candidate is (-r_0 : r_1), and that one is common iff g is zero there.
#pragma once

#include <algorithm>

#include "narrowphase/exact/wide.hpp"

namespace onset {

// Widths for coordinates of q, a, b below 2^c. By the sums of products in exact_search.hpp, with every
// product of k coordinates below 2^(k c): |a_i| < 54 2^(3c), |b_i| < 24 2^(2c); the first step of the
// division is below 2 * 54 * 24 2^(5c), r below 2 * 24 * 2592 2^(7c) < 2^(7c + 17), at k / 2^depth, depth <=
// 24, below 2^(7c + 42), and g at the candidate below 3 * 24 * 124416^2 2^(16c) < 2^(16c + 41).
template <int RemainderLimbs, int ValueLimbs>
struct CommonRootWidths {
  static constexpr bool fit(int c) {
    return 7 * c + 43 <= 64 * RemainderLimbs && 16 * c + 42 <= 64 * ValueLimbs;
  }
};
using NarrowCommonRoot = CommonRootWidths<8, 17>;  // c <= 65
using WideCommonRoot = CommonRootWidths<14, 31>;   // c <= 121

// Bernstein coefficients on [0, 1], each polynomial up to a factor of its own; the cubic has one root, a
// simple one, between k / 2^depth and (k + 1) / 2^depth, and is not zero at these. Whether the quadratic, not
// zero throughout, vanishes at that root; changes_sign: its signs at the two ends are opposite.
template <int RemainderLimbs, int ValueLimbs, class T>
bool vanishes_at_root(CommonRootWidths<RemainderLimbs, ValueLimbs>, const T (&cubic)[4],
                      const T (&quadratic)[3], std::uint64_t k, int depth, bool changes_sign) {
  using R = Wide<RemainderLimbs>;
  R a[4] = {cubic[0], cubic[1] + cubic[1] + cubic[1], cubic[2] + cubic[2] + cubic[2], cubic[3]};
  R b[3] = {quadratic[0], quadratic[1] + quadratic[1], quadratic[2]};
  const bool swapped = sign_of(b[2]) == 0;
  if (swapped) std::reverse(a, a + 4), std::reverse(b, b + 3);
  if (sign_of(b[2]) == 0) return false;  // b_1 x y, zero at 0 and 1 only
  const R c2 = b[2] * a[2] - a[3] * b[1], c1 = b[2] * a[1] - a[3] * b[0], c0 = b[2] * a[0];
  const R r1 = b[2] * c1 - c2 * b[1], r0 = b[2] * c0 - c2 * b[0];
  // Where g divides f a root of g in the interval is f's, and simple.
  if (sign_of(r1) == 0) return sign_of(r0) == 0 && changes_sign;
  const R one = shifted(R(1), depth);
  const auto side = [&](std::int64_t n) {
    const R x = n, y = one - x;
    return sign_of(swapped ? r1 * y + r0 * x : r1 * x + r0 * y);
  };
  if (side(std::int64_t(k)) * side(std::int64_t(k) + 1) >= 0) return false;
  using V = Wide<ValueLimbs>;
  const V x(-r0), y(r1);
  return sign_of((V(b[0]) * y + V(b[1]) * x) * y + V(b[2]) * (x * x)) == 0;
}

}  // namespace onset
