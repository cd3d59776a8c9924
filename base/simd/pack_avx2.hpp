// The packs of base/simd/pack.hpp as AVX2 registers.
#pragma once

#include <immintrin.h>

#include "base/simd/lane_table.hpp"

namespace onset {
namespace ONSET_ISA {
namespace {

struct MaskD4 {
  __m256d m;
};
struct D4 {
  using Scalar = double;
  using Mask = MaskD4;
  static constexpr int lanes = 4;
  __m256d v;
  static D4 all(double x) { return {_mm256_set1_pd(x)}; }
  static D4 load(const double* p) { return {_mm256_loadu_pd(p)}; }
  void store(double* p) const { _mm256_storeu_pd(p, v); }
};
inline D4 operator+(D4 a, D4 b) { return {_mm256_add_pd(a.v, b.v)}; }
inline D4 operator-(D4 a, D4 b) { return {_mm256_sub_pd(a.v, b.v)}; }
inline D4 operator*(D4 a, D4 b) { return {_mm256_mul_pd(a.v, b.v)}; }
inline D4 operator/(D4 a, D4 b) { return {_mm256_div_pd(a.v, b.v)}; }
inline D4 sqrt(D4 a) { return {_mm256_sqrt_pd(a.v)}; }
inline D4 min(D4 a, D4 b) { return {_mm256_min_pd(a.v, b.v)}; }
inline D4 max(D4 a, D4 b) { return {_mm256_max_pd(a.v, b.v)}; }
inline D4 abs(D4 a) { return {_mm256_andnot_pd(_mm256_set1_pd(-0.0), a.v)}; }
inline MaskD4 operator<(D4 a, D4 b) { return {_mm256_cmp_pd(a.v, b.v, _CMP_LT_OQ)}; }
inline MaskD4 operator<=(D4 a, D4 b) { return {_mm256_cmp_pd(a.v, b.v, _CMP_LE_OQ)}; }
inline MaskD4 operator>(D4 a, D4 b) { return {_mm256_cmp_pd(a.v, b.v, _CMP_GT_OQ)}; }
inline MaskD4 operator>=(D4 a, D4 b) { return {_mm256_cmp_pd(a.v, b.v, _CMP_GE_OQ)}; }
inline MaskD4 operator==(D4 a, D4 b) { return {_mm256_cmp_pd(a.v, b.v, _CMP_EQ_OQ)}; }
inline MaskD4 operator&(MaskD4 a, MaskD4 b) { return {_mm256_and_pd(a.m, b.m)}; }
inline MaskD4 operator|(MaskD4 a, MaskD4 b) { return {_mm256_or_pd(a.m, b.m)}; }
inline D4 select(MaskD4 m, D4 a, D4 b) { return {_mm256_blendv_pd(b.v, a.v, m.m)}; }
inline int bits(MaskD4 m) { return _mm256_movemask_pd(m.m); }

struct MaskF8 {
  __m256 m;
};
struct F8 {
  using Scalar = float;
  using Mask = MaskF8;
  static constexpr int lanes = 8;
  __m256 v;
  static F8 all(float x) { return {_mm256_set1_ps(x)}; }
  static F8 load(const float* p) { return {_mm256_loadu_ps(p)}; }
  void store(float* p) const { _mm256_storeu_ps(p, v); }
};
inline F8 operator+(F8 a, F8 b) { return {_mm256_add_ps(a.v, b.v)}; }
inline F8 operator-(F8 a, F8 b) { return {_mm256_sub_ps(a.v, b.v)}; }
inline F8 operator*(F8 a, F8 b) { return {_mm256_mul_ps(a.v, b.v)}; }
inline F8 operator/(F8 a, F8 b) { return {_mm256_div_ps(a.v, b.v)}; }
inline F8 sqrt(F8 a) { return {_mm256_sqrt_ps(a.v)}; }
inline F8 min(F8 a, F8 b) { return {_mm256_min_ps(a.v, b.v)}; }
inline F8 max(F8 a, F8 b) { return {_mm256_max_ps(a.v, b.v)}; }
inline F8 abs(F8 a) { return {_mm256_andnot_ps(_mm256_set1_ps(-0.0f), a.v)}; }
inline MaskF8 operator<(F8 a, F8 b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ)}; }
inline MaskF8 operator<=(F8 a, F8 b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_LE_OQ)}; }
inline MaskF8 operator>(F8 a, F8 b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_GT_OQ)}; }
inline MaskF8 operator>=(F8 a, F8 b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_GE_OQ)}; }
inline MaskF8 operator==(F8 a, F8 b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_EQ_OQ)}; }
inline MaskF8 operator&(MaskF8 a, MaskF8 b) { return {_mm256_and_ps(a.m, b.m)}; }
inline MaskF8 operator|(MaskF8 a, MaskF8 b) { return {_mm256_or_ps(a.m, b.m)}; }
inline F8 select(MaskF8 m, F8 a, F8 b) { return {_mm256_blendv_ps(b.v, a.v, m.m)}; }
inline int bits(MaskF8 m) { return _mm256_movemask_ps(m.m); }

// Loads x, y, z of the points at each p[l] + at (four doubles each), one point a lane.
inline void transpose(const double* const (&p)[4], int at, D4 (&xyz)[3]) {
  const __m256d a = _mm256_loadu_pd(p[0] + at), b = _mm256_loadu_pd(p[1] + at),
                c = _mm256_loadu_pd(p[2] + at), d = _mm256_loadu_pd(p[3] + at);
  const __m256d ab_lo = _mm256_unpacklo_pd(a, b), ab_hi = _mm256_unpackhi_pd(a, b);
  const __m256d cd_lo = _mm256_unpacklo_pd(c, d), cd_hi = _mm256_unpackhi_pd(c, d);
  xyz[0].v = _mm256_permute2f128_pd(ab_lo, cd_lo, 0x20);
  xyz[1].v = _mm256_permute2f128_pd(ab_hi, cd_hi, 0x20);
  xyz[2].v = _mm256_permute2f128_pd(ab_lo, cd_lo, 0x31);
}
// Loads the first seven of the eight floats at each p[l], one p a lane.
inline void transpose(const float* const (&p)[8], F8 (&out)[7]) {
  const auto both = [&](int l, int at) {  // four floats of lane l and of lane l + 4
    return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(p[l] + at)), _mm_loadu_ps(p[l + 4] + at),
                                1);
  };
  for (int half = 0; half < 2; ++half) {
    const __m256 a = both(0, 4 * half), b = both(1, 4 * half), c = both(2, 4 * half), d = both(3, 4 * half);
    const __m256d ab_lo = _mm256_castps_pd(_mm256_unpacklo_ps(a, b)),
                  cd_lo = _mm256_castps_pd(_mm256_unpacklo_ps(c, d));
    const __m256d ab_hi = _mm256_castps_pd(_mm256_unpackhi_ps(a, b)),
                  cd_hi = _mm256_castps_pd(_mm256_unpackhi_ps(c, d));
    out[4 * half].v = _mm256_castpd_ps(_mm256_unpacklo_pd(ab_lo, cd_lo));
    out[4 * half + 1].v = _mm256_castpd_ps(_mm256_unpackhi_pd(ab_lo, cd_lo));
    out[4 * half + 2].v = _mm256_castpd_ps(_mm256_unpacklo_pd(ab_hi, cd_hi));
    if (half == 0) out[3].v = _mm256_castpd_ps(_mm256_unpackhi_pd(ab_hi, cd_hi));
  }
}
// Returns the power of two that brings x > 0 into [1, 2), a subnormal x into [2^-51, 2); for 0, 2^1023.
inline D4 inverse_power_of_two(D4 x) {
  const __m256i exponent = _mm256_and_si256(_mm256_castpd_si256(x.v), _mm256_set1_epi64x(0x7ff0000000000000));
  return {_mm256_castsi256_pd(_mm256_sub_epi64(_mm256_set1_epi64x(0x7fe0000000000000), exponent))};
}
inline void to_double(F8 a, D4& lo, D4& hi) {
  lo.v = _mm256_cvtps_pd(_mm256_castps256_ps128(a.v));
  hi.v = _mm256_cvtps_pd(_mm256_extractf128_ps(a.v, 1));
}
// The second four lanes before the first.
inline F8 swap_halves(F8 a) { return {_mm256_permute2f128_ps(a.v, a.v, 1)}; }
inline F8 to_float(D4 lo, D4 hi) {
  return {_mm256_insertf128_ps(_mm256_castps128_ps256(_mm256_cvtpd_ps(lo.v)), _mm256_cvtpd_ps(hi.v), 1)};
}

// These work bit by bit.
inline F8 operator&(F8 a, F8 b) { return {_mm256_and_ps(a.v, b.v)}; }
// Takes a where the sign bit of `sign` is set, else b.
inline F8 where_negative(F8 sign, F8 a, F8 b) { return {_mm256_blendv_ps(b.v, a.v, sign.v)}; }
// Bit i of the result is the sign bit of lane i.
inline int sign_bits(F8 a) { return _mm256_movemask_ps(a.v); }
__attribute__((always_inline)) inline F8 collect(const float* const* p, int i) {  // lane l: p[l][i]
  return {_mm256_setr_ps(p[0][i], p[1][i], p[2][i], p[3][i], p[4][i], p[5][i], p[6][i], p[7][i])};
}

struct I8 {
  static constexpr int lanes = 8;
  __m256i v;
  static I8 all(int x) { return {_mm256_set1_epi32(x)}; }
  static I8 load(const int* p) { return {_mm256_loadu_si256(reinterpret_cast<const __m256i*>(p))}; }
  static I8 lane_numbers() { return {_mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7)}; }
  void store(int* p) const { _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), v); }
};
inline I8 operator+(I8 a, I8 b) { return {_mm256_add_epi32(a.v, b.v)}; }
inline I8 min(I8 a, I8 b) { return {_mm256_min_epi32(a.v, b.v)}; }
inline I8 max(I8 a, I8 b) { return {_mm256_max_epi32(a.v, b.v)}; }
inline I8 operator|(I8 a, I8 b) { return {_mm256_or_si256(a.v, b.v)}; }
inline I8 operator&(I8 a, I8 b) { return {_mm256_and_si256(a.v, b.v)}; }
// Sets all bits of the lanes that are equal.
inline I8 operator==(I8 a, I8 b) { return {_mm256_cmpeq_epi32(a.v, b.v)}; }
inline int sign_bits(I8 a) { return _mm256_movemask_ps(_mm256_castsi256_ps(a.v)); }
inline I8 bits_of(F8 a) { return {_mm256_castps_si256(a.v)}; }

// Moves the lanes of `mask` to the front; what follows them is unspecified.
inline I8 compress(I8 x, int mask) {
  const __m128i lanes = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(kLaneTable.lane[mask]));
  return {_mm256_permutevar8x32_epi32(x.v, _mm256_cvtepu8_epi32(lanes))};
}

// p[0..15] = a0 b0 a1 b1 ...
inline void store_interleaved(int* p, I8 a, I8 b) {
  const __m256i lo = _mm256_unpacklo_epi32(a.v, b.v), hi = _mm256_unpackhi_epi32(a.v, b.v);
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), _mm256_permute2x128_si256(lo, hi, 0x20));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(p + 8), _mm256_permute2x128_si256(lo, hi, 0x31));
}

// Exchanges lane j of x[i] with lane i of x[j], for 8 packs.
__attribute__((always_inline)) inline void transpose(F8* x) {
  __m256 a[8], b[8];
  for (int i = 0; i < 4; ++i) {
    a[2 * i] = _mm256_unpacklo_ps(x[2 * i].v, x[2 * i + 1].v);
    a[2 * i + 1] = _mm256_unpackhi_ps(x[2 * i].v, x[2 * i + 1].v);
  }
  for (int i = 0; i < 2; ++i) {
    b[4 * i] = _mm256_shuffle_ps(a[4 * i], a[4 * i + 2], 0x44);
    b[4 * i + 1] = _mm256_shuffle_ps(a[4 * i], a[4 * i + 2], 0xee);
    b[4 * i + 2] = _mm256_shuffle_ps(a[4 * i + 1], a[4 * i + 3], 0x44);
    b[4 * i + 3] = _mm256_shuffle_ps(a[4 * i + 1], a[4 * i + 3], 0xee);
  }
  for (int i = 0; i < 4; ++i) {
    x[i].v = _mm256_permute2f128_ps(b[i], b[i + 4], 0x20);
    x[i + 4].v = _mm256_permute2f128_ps(b[i], b[i + 4], 0x31);
  }
}

}  // namespace
}  // namespace ONSET_ISA
}  // namespace onset
