// Lanes of numbers as the kernels see them: D4 (four doubles), F8 (eight floats) and I8 (eight ints), with masks of the first two.
//
// A kernel text includes this inside a translation unit that defines ONSET_ISA, the namespace of its instruction set's copy. With
// AVX2 enabled there the packs are registers, else two halves in the vector types of GCC and Clang (SSE2 on every x86-64, NEON on
// Arm, plain code elsewhere). Both give the same bits for every input: only IEEE + - * / sqrt, comparisons and bit operations are
// used, min and max are `a < b ? a : b` and `a > b ? a : b` (the second operand wins on NaN or equality, as vminpd does), and
// nothing is contracted (-ffp-contract=off). All of it has internal linkage, so that no copy compiled for AVX2 is ever shared.
#pragma once

#ifndef ONSET_ISA
#error "define ONSET_ISA, the namespace of this instruction set's copy, before including base/simd/pack.hpp"
#endif

#if defined(__AVX2__)
#include "base/simd/pack_avx2.hpp"
#else
#include "base/simd/pack_halves.hpp"
#endif

namespace onset {
namespace ONSET_ISA {
namespace {

inline int lowest_lane(int mask) { return __builtin_ctz(unsigned(mask)); }
inline int count_lanes(int mask) { return __builtin_popcount(unsigned(mask)); }

// Sums run in one fixed order everywhere.
template <class V>
inline V dot(const V (&a)[3], const V (&b)[3]) {
  return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}
template <class V>
inline void cross(const V (&a)[3], const V (&b)[3], V (&r)[3]) {
  r[0] = a[1] * b[2] - a[2] * b[1];
  r[1] = a[2] * b[0] - a[0] * b[2];
  r[2] = a[0] * b[1] - a[1] * b[0];
}
// Exact at t = 0 and t = 1.
template <class V>
inline V lerp(V a, V b, V t) {
  return (V::all(1) - t) * a + t * b;
}

}  // namespace
}  // namespace ONSET_ISA
}  // namespace onset
