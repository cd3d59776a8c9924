// The packs of base/simd/pack.hpp as two halves of 16 bytes each, in the vector types of GCC and Clang.
#pragma once

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include "base/simd/lane_table.hpp"

namespace onset {
namespace ONSET_ISA {
namespace {

typedef double Double2 __attribute__((vector_size(16)));
typedef float Float4 __attribute__((vector_size(16)));
typedef long long Long2 __attribute__((vector_size(16)));
typedef int Int4 __attribute__((vector_size(16)));

inline Double2 spread(double x) { return Double2{x, x}; }
inline Float4 spread(float x) { return Float4{x, x, x, x}; }
inline Int4 spread(int x) { return Int4{x, x, x, x}; }
template <class Half, class T>
inline Half load_half(const T* p) {
  Half h;
  __builtin_memcpy(&h, p, sizeof h);
  return h;
}

template <class Bits>
struct Mask {
  Bits lo, hi;
};
// T is the number of a lane, Half a vector of half of the lanes, Bits as many integers.
template <class T, class Half, class Bits>
struct Pack {
  using Scalar = T;
  using Mask = ONSET_ISA::Mask<Bits>;
  static constexpr int lanes = int(32 / sizeof(T));
  Half lo, hi;
  static Pack all(T x) { return {spread(x), spread(x)}; }
  static Pack load(const T* p) { return {load_half<Half>(p), load_half<Half>(p + lanes / 2)}; }
  void store(T* p) const { __builtin_memcpy(p, this, sizeof *this); }
};
using D4 = Pack<double, Double2, Long2>;
using F8 = Pack<float, Float4, Int4>;
struct I8 : Pack<int, Int4, Int4> {
  static I8 all(int x) { return {{spread(x), spread(x)}}; }
  static I8 load(const int* p) { return {{load_half<Int4>(p), load_half<Int4>(p + 4)}}; }
  static I8 lane_numbers() { return {{Int4{0, 1, 2, 3}, Int4{4, 5, 6, 7}}}; }
};

#define ONSET_EACH_HALF(signature, expression_of_lo, expression_of_hi) \
  template <class T, class H, class B>                                 \
  inline Pack<T, H, B> signature {                                     \
    return {expression_of_lo, expression_of_hi};                       \
  }
#define ONSET_P const Pack<T, H, B>&
ONSET_EACH_HALF(operator+(ONSET_P a, ONSET_P b), a.lo + b.lo, a.hi + b.hi)
ONSET_EACH_HALF(operator-(ONSET_P a, ONSET_P b), a.lo - b.lo, a.hi - b.hi)
ONSET_EACH_HALF(operator*(ONSET_P a, ONSET_P b), a.lo* b.lo, a.hi* b.hi)
ONSET_EACH_HALF(operator/(ONSET_P a, ONSET_P b), a.lo / b.lo, a.hi / b.hi)
ONSET_EACH_HALF(min(ONSET_P a, ONSET_P b), a.lo < b.lo ? a.lo : b.lo, a.hi < b.hi ? a.hi : b.hi)
ONSET_EACH_HALF(max(ONSET_P a, ONSET_P b), a.lo > b.lo ? a.lo : b.lo, a.hi > b.hi ? a.hi : b.hi)
#undef ONSET_EACH_HALF
#define ONSET_COMPARE(op)                            \
  template <class T, class H, class B>               \
  inline Mask<B> operator op(ONSET_P a, ONSET_P b) { \
    return {(B)(a.lo op b.lo), (B)(a.hi op b.hi)};   \
  }
ONSET_COMPARE(<)
ONSET_COMPARE(<=)
ONSET_COMPARE(>)
ONSET_COMPARE(>=)
ONSET_COMPARE(==)
#undef ONSET_COMPARE
#undef ONSET_P
template <class B>
inline Mask<B> operator&(const Mask<B>& a, const Mask<B>& b) {
  return {a.lo & b.lo, a.hi & b.hi};
}
template <class B>
inline Mask<B> operator|(const Mask<B>& a, const Mask<B>& b) {
  return {a.lo | b.lo, a.hi | b.hi};
}
template <class T, class H, class B>
inline Pack<T, H, B> select(const Mask<B>& m, const Pack<T, H, B>& a, const Pack<T, H, B>& b) {
  return {(H)((m.lo & (B)a.lo) | (~m.lo & (B)b.lo)), (H)((m.hi & (B)a.hi) | (~m.hi & (B)b.hi))};
}

inline D4 sqrt(const D4& a) {
#ifdef __SSE2__
  return {_mm_sqrt_pd(a.lo), _mm_sqrt_pd(a.hi)};
#else
  return {Double2{__builtin_sqrt(a.lo[0]), __builtin_sqrt(a.lo[1])},
          Double2{__builtin_sqrt(a.hi[0]), __builtin_sqrt(a.hi[1])}};
#endif
}
inline Float4 root(Float4 a) {
#ifdef __SSE2__
  return _mm_sqrt_ps(a);
#else
  return Float4{__builtin_sqrtf(a[0]), __builtin_sqrtf(a[1]), __builtin_sqrtf(a[2]), __builtin_sqrtf(a[3])};
#endif
}
inline F8 sqrt(const F8& a) { return {root(a.lo), root(a.hi)}; }
inline D4 abs(const D4& a) {
  return {(Double2)((Long2)a.lo & 0x7fffffffffffffff), (Double2)((Long2)a.hi & 0x7fffffffffffffff)};
}
inline F8 abs(const F8& a) { return {(Float4)((Int4)a.lo & 0x7fffffff), (Float4)((Int4)a.hi & 0x7fffffff)}; }

inline int sign_bits(Int4 x) {
#ifdef __SSE2__
  return _mm_movemask_ps((Float4)x);
#else
  const Int4 bits = (x < 0) & Int4{1, 2, 4, 8};
  return (bits[0] | bits[1]) | (bits[2] | bits[3]);
#endif
}
inline int sign_bits(Long2 x) {
#ifdef __SSE2__
  return _mm_movemask_pd((Double2)x);
#else
  return int(x[0] < 0) | int(x[1] < 0) << 1;
#endif
}
inline int bits(const Mask<Int4>& m) { return sign_bits(m.lo) | sign_bits(m.hi) << 4; }
inline int bits(const Mask<Long2>& m) { return sign_bits(m.lo) | sign_bits(m.hi) << 2; }
// Bit i of the result is the sign bit of lane i.
inline int sign_bits(const F8& a) { return sign_bits((Int4)a.lo) | sign_bits((Int4)a.hi) << 4; }
inline int sign_bits(const I8& a) { return sign_bits(a.lo) | sign_bits(a.hi) << 4; }

// These work bit by bit.
inline F8 operator&(const F8& a, const F8& b) {
  return {(Float4)((Int4)a.lo & (Int4)b.lo), (Float4)((Int4)a.hi & (Int4)b.hi)};
}
// Takes a where the sign bit of `sign` is set, else b.
inline F8 where_negative(const F8& sign, const F8& a, const F8& b) {
  return {(Int4)sign.lo < 0 ? a.lo : b.lo, (Int4)sign.hi < 0 ? a.hi : b.hi};
}
__attribute__((always_inline)) inline F8 collect(const float* const* p, int i) {  // lane l: p[l][i]
  return {Float4{p[0][i], p[1][i], p[2][i], p[3][i]}, Float4{p[4][i], p[5][i], p[6][i], p[7][i]}};
}

inline I8 operator+(const I8& a, const I8& b) { return {{a.lo + b.lo, a.hi + b.hi}}; }
inline I8 min(const I8& a, const I8& b) { return {{a.lo < b.lo ? a.lo : b.lo, a.hi < b.hi ? a.hi : b.hi}}; }
inline I8 max(const I8& a, const I8& b) { return {{a.lo > b.lo ? a.lo : b.lo, a.hi > b.hi ? a.hi : b.hi}}; }
inline I8 operator|(const I8& a, const I8& b) { return {{a.lo | b.lo, a.hi | b.hi}}; }
inline I8 operator&(const I8& a, const I8& b) { return {{a.lo & b.lo, a.hi & b.hi}}; }
// Sets all bits of the lanes that are equal.
inline I8 operator==(const I8& a, const I8& b) { return {{a.lo == b.lo, a.hi == b.hi}}; }
inline I8 bits_of(const F8& a) { return {{(Int4)a.lo, (Int4)a.hi}}; }

// Moves the lanes of `mask` to the front; what follows them is unspecified.
inline I8 compress(const I8& x, int mask) {
  int from[8], to[8];
  x.store(from);
  for (int i = 0; i < 8; ++i) to[i] = from[kLaneTable.lane[mask][i]];
  return I8::load(to);
}

// p[0..15] = a0 b0 a1 b1 ...
inline void store_interleaved(int* p, const I8& a, const I8& b) {
  int as[8], bs[8];
  a.store(as), b.store(bs);
  for (int i = 0; i < 8; ++i) p[2 * i] = as[i], p[2 * i + 1] = bs[i];
}

// Exchanges lane j of x[i] with lane i of x[j], for 8 packs.
__attribute__((always_inline)) inline void transpose(F8* x) {
  float from[8][8];
  for (int i = 0; i < 8; ++i) x[i].store(from[i]);
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j) {
      Float4& half = j < 4 ? x[i].lo : x[i].hi;
      half[j % 4] = from[j][i];
    }
}
// Loads x, y, z of the points at each p[l] + at (four doubles each), one point a lane.
inline void transpose(const double* const (&p)[4], int at, D4 (&xyz)[3]) {
  for (int a = at; a < at + 3; ++a) xyz[a - at] = {Double2{p[0][a], p[1][a]}, Double2{p[2][a], p[3][a]}};
}
// Loads the first seven of the eight floats at each p[l], one p a lane.
inline void transpose(const float* const (&p)[8], F8 (&out)[7]) {
  for (int i = 0; i < 7; ++i) out[i] = collect(p, i);
}
// Returns the power of two that brings x > 0 into [1, 2), a subnormal x into [2^-51, 2); for 0, 2^1023.
inline Double2 inverse_power_of_two(Double2 x) {
  return (Double2)(0x7fe0000000000000 - ((Long2)x & 0x7ff0000000000000));
}
inline D4 inverse_power_of_two(const D4& x) {
  return {inverse_power_of_two(x.lo), inverse_power_of_two(x.hi)};
}
inline void to_double(const F8& a, D4& lo, D4& hi) {
  lo = {Double2{a.lo[0], a.lo[1]}, Double2{a.lo[2], a.lo[3]}};
  hi = {Double2{a.hi[0], a.hi[1]}, Double2{a.hi[2], a.hi[3]}};
}
// The second four lanes before the first.
inline F8 swap_halves(const F8& a) { return {a.hi, a.lo}; }
inline F8 to_float(const D4& lo, const D4& hi) {
  return {Float4{float(lo.lo[0]), float(lo.lo[1]), float(lo.hi[0]), float(lo.hi[1])},
          Float4{float(hi.lo[0]), float(hi.lo[1]), float(hi.hi[0]), float(hi.hi[1])}};
}

}  // namespace
}  // namespace ONSET_ISA
}  // namespace onset
