// Lanes of numbers for the kernels: D4 (four doubles), F8 (eight floats), I8 (eight ints), and masks. A text
// of generic width calls them Doubles, Floats and Ints, and is compiled for packs of twice as many lanes
// where its translation unit defines ONSET_WIDE_PACKS and enables AVX-512.
//
// The translation unit of a kernel text defines ONSET_ISA, the namespace of its copy. With AVX2 enabled
// there, packs are registers, as with AVX-512; else they are two halves in the vector types of GCC and Clang
// (SSE2 on x86-64, NEON on Arm, else plain code). All give the same bits for every input: only IEEE + - * /
// sqrt, comparisons and bit operations are used; min and max are `a < b ? a : b` and `a > b ? a : b`, where
// the second operand wins on NaN or equality, as in vminpd; nothing is contracted (-ffp-contract=off). All
// has internal linkage, so that the linker never shares a copy compiled for a newer set.
#pragma once

#ifndef ONSET_ISA
#error "define ONSET_ISA, the namespace of this instruction set's copy, before including base/simd/pack.hpp"
#endif

#if defined(ONSET_WIDE_PACKS)
#include "base/simd/pack_avx512.hpp"
#elif defined(__AVX2__)
#include "base/simd/pack_avx2.hpp"
#else
#include "base/simd/pack_halves.hpp"
#endif

namespace onset {
namespace ONSET_ISA {
namespace {

#if defined(ONSET_WIDE_PACKS)
using Doubles = D8;
using Floats = F16;
using Ints = I16;
#else
using Doubles = D4;
using Floats = F8;
using Ints = I8;
#endif

inline int lowest_lane(int mask) { return __builtin_ctz(unsigned(mask)); }
inline int count_lanes(int mask) { return __builtin_popcount(unsigned(mask)); }

// Sums run in one order everywhere, which error bounds count on (docs/theory.md, 1.1).
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
// Mixes a and b; exact at t = 0 and t = 1.
template <class V>
inline V lerp(V a, V b, V t) {
  return (V::all(1) - t) * a + t * b;
}

}  // namespace
}  // namespace ONSET_ISA
}  // namespace onset
