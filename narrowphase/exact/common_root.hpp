// Is a quadratic zero at a cubic's root? In integers of fixed width (docs/theory.md, L40).
//
// As forms f = sum a_i x^i y^(3 - i), g = sum b_i x^i y^(2 - i), t = x / (x + y): the remainder b_2^2 f mod g
// = r_1 x + r_0 y is zero at common roots, so unless it vanishes (-r_0 : r_1) is the only candidate.
#pragma once

#include <algorithm>

#include "narrowphase/exact/wide.hpp"

namespace onset {

// For coordinates of q, a, b below 2^c the remainder at k / 2^depth, depth <= 24, is below 2^(7c + 42), g at
// the candidate below 2^(16c + 41).
template <int RemainderLimbs, int ValueLimbs>
struct CommonRootWidths {
  static constexpr bool fit(int c) {
    return 7 * c + 43 <= 64 * RemainderLimbs && 16 * c + 42 <= 64 * ValueLimbs;
  }
};
using NarrowCommonRoot = CommonRootWidths<8, 17>;  // c <= 65
using WideCommonRoot = CommonRootWidths<14, 31>;   // c <= 121

// Tells whether the quadratic, not zero throughout, vanishes at the cubic's only and simple root in the open
// interval [k, k + 1] / 2^depth, at whose ends the cubic is not zero. changes_sign: the quadratic's signs
// there are opposite. Bernstein coefficients are on [0, 1], up to a factor.
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
