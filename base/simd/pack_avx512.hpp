// Packs of twice as many lanes as those of base/simd/pack.hpp, as AVX-512 registers; masks are registers of
// their own. What a text of generic width does not ask for is left out.
#pragma once

#include <immintrin.h>

namespace onset {
namespace ONSET_ISA {
namespace {

struct MaskD8 {
  __mmask8 m;
};
struct D8 {
  using Scalar = double;
  using Mask = MaskD8;
  static constexpr int lanes = 8;
  __m512d v;
  static D8 all(double x) { return {_mm512_set1_pd(x)}; }
  static D8 load(const double* p) { return {_mm512_loadu_pd(p)}; }
  void store(double* p) const { _mm512_storeu_pd(p, v); }
};
inline D8 operator+(D8 a, D8 b) { return {_mm512_add_pd(a.v, b.v)}; }
inline D8 operator-(D8 a, D8 b) { return {_mm512_sub_pd(a.v, b.v)}; }
inline D8 operator*(D8 a, D8 b) { return {_mm512_mul_pd(a.v, b.v)}; }
inline D8 operator/(D8 a, D8 b) { return {_mm512_div_pd(a.v, b.v)}; }
inline D8 sqrt(D8 a) { return {_mm512_maskz_sqrt_pd(0xff, a.v)}; }
inline D8 min(D8 a, D8 b) { return {_mm512_maskz_min_pd(0xff, a.v, b.v)}; }
inline D8 max(D8 a, D8 b) { return {_mm512_maskz_max_pd(0xff, a.v, b.v)}; }
inline D8 abs(D8 a) { return {_mm512_maskz_andnot_pd(0xff, _mm512_set1_pd(-0.0), a.v)}; }
inline MaskD8 operator<(D8 a, D8 b) { return {_mm512_cmp_pd_mask(a.v, b.v, _CMP_LT_OQ)}; }
inline MaskD8 operator<=(D8 a, D8 b) { return {_mm512_cmp_pd_mask(a.v, b.v, _CMP_LE_OQ)}; }
inline MaskD8 operator>(D8 a, D8 b) { return {_mm512_cmp_pd_mask(a.v, b.v, _CMP_GT_OQ)}; }
inline MaskD8 operator>=(D8 a, D8 b) { return {_mm512_cmp_pd_mask(a.v, b.v, _CMP_GE_OQ)}; }
inline MaskD8 operator==(D8 a, D8 b) { return {_mm512_cmp_pd_mask(a.v, b.v, _CMP_EQ_OQ)}; }
inline MaskD8 operator&(MaskD8 a, MaskD8 b) { return {_kand_mask8(a.m, b.m)}; }
inline MaskD8 operator|(MaskD8 a, MaskD8 b) { return {_kor_mask8(a.m, b.m)}; }
inline D8 select(MaskD8 m, D8 a, D8 b) { return {_mm512_mask_blend_pd(m.m, b.v, a.v)}; }
inline int bits(MaskD8 m) { return int(_cvtmask8_u32(m.m)); }

struct MaskF16 {
  __mmask16 m;
};
struct F16 {
  using Scalar = float;
  using Mask = MaskF16;
  static constexpr int lanes = 16;
  __m512 v;
  static F16 all(float x) { return {_mm512_set1_ps(x)}; }
  static F16 load(const float* p) { return {_mm512_loadu_ps(p)}; }
  void store(float* p) const { _mm512_storeu_ps(p, v); }
};
inline F16 operator+(F16 a, F16 b) { return {_mm512_add_ps(a.v, b.v)}; }
inline F16 operator-(F16 a, F16 b) { return {_mm512_sub_ps(a.v, b.v)}; }
inline F16 operator*(F16 a, F16 b) { return {_mm512_mul_ps(a.v, b.v)}; }
inline F16 operator/(F16 a, F16 b) { return {_mm512_div_ps(a.v, b.v)}; }
inline F16 sqrt(F16 a) { return {_mm512_maskz_sqrt_ps(0xffff, a.v)}; }
inline F16 min(F16 a, F16 b) { return {_mm512_maskz_min_ps(0xffff, a.v, b.v)}; }
inline F16 max(F16 a, F16 b) { return {_mm512_maskz_max_ps(0xffff, a.v, b.v)}; }
inline F16 abs(F16 a) { return {_mm512_maskz_andnot_ps(0xffff, _mm512_set1_ps(-0.0f), a.v)}; }
inline MaskF16 operator<(F16 a, F16 b) { return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ)}; }
inline MaskF16 operator<=(F16 a, F16 b) { return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_LE_OQ)}; }
inline MaskF16 operator>(F16 a, F16 b) { return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_GT_OQ)}; }
inline MaskF16 operator>=(F16 a, F16 b) { return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_GE_OQ)}; }
inline MaskF16 operator==(F16 a, F16 b) { return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_EQ_OQ)}; }
inline MaskF16 operator&(MaskF16 a, MaskF16 b) { return {_kand_mask16(a.m, b.m)}; }
inline MaskF16 operator|(MaskF16 a, MaskF16 b) { return {_kor_mask16(a.m, b.m)}; }
inline F16 select(MaskF16 m, F16 a, F16 b) { return {_mm512_mask_blend_ps(m.m, b.v, a.v)}; }
inline int bits(MaskF16 m) { return int(_cvtmask16_u32(m.m)); }

// Two quarters of a, then two of b: their first and third where `from` is 0x88, second and fourth where it is
// 0xdd. (Shuffles with a mask of all lanes read no register that was never written, which GCC warns of.)
template <int from>
inline __m512d quarters(__m512d a, __m512d b) {
  return _mm512_maskz_shuffle_f64x2(0xff, a, b, from);
}
template <int from>
inline __m512 quarters(__m512 a, __m512 b) {
  return _mm512_maskz_shuffle_f32x4(0xffff, a, b, from);
}

// Loads x, y, z of the points at each p[l] + at (four doubles each), one point a lane.
inline void transpose(const double* const (&p)[8], int at, D8 (&xyz)[3]) {
  const auto both = [&](int l) {  // the points of lanes l and l + 2
    return _mm512_maskz_insertf64x4(0xff, _mm512_castpd256_pd512(_mm256_loadu_pd(p[l] + at)),
                                    _mm256_loadu_pd(p[l + 2] + at), 1);
  };
  const __m512d a = both(0), b = both(1), c = both(4), d = both(5);
  const __m512d ab_lo = _mm512_maskz_unpacklo_pd(0xff, a, b), ab_hi = _mm512_maskz_unpackhi_pd(0xff, a, b);
  const __m512d cd_lo = _mm512_maskz_unpacklo_pd(0xff, c, d), cd_hi = _mm512_maskz_unpackhi_pd(0xff, c, d);
  xyz[0].v = quarters<0x88>(ab_lo, cd_lo);
  xyz[1].v = quarters<0x88>(ab_hi, cd_hi);
  xyz[2].v = quarters<0xdd>(ab_lo, cd_lo);
}
// Loads the first seven of the eight floats at each p[l], one p a lane.
inline void transpose(const float* const (&p)[16], F16 (&out)[7]) {
  // Of lanes 0 to 7 and of 8 to 15: floats i of four lanes, floats i + 4 of them, then those of the other
  // four.
  __m512 column[2][4];
  for (int half = 0; half < 2; ++half) {
    const auto both = [&](int l) {  // the floats of lanes l and l + 4
      return _mm512_maskz_insertf32x8(0xffff, _mm512_castps256_ps512(_mm256_loadu_ps(p[l])),
                                      _mm256_loadu_ps(p[l + 4]), 1);
    };
    const int l = 8 * half;
    const __m512 a = both(l), b = both(l + 1), c = both(l + 2), d = both(l + 3);
    const __m512d ab_lo = _mm512_castps_pd(_mm512_maskz_unpacklo_ps(0xffff, a, b)),
                  cd_lo = _mm512_castps_pd(_mm512_maskz_unpacklo_ps(0xffff, c, d)),
                  ab_hi = _mm512_castps_pd(_mm512_maskz_unpackhi_ps(0xffff, a, b)),
                  cd_hi = _mm512_castps_pd(_mm512_maskz_unpackhi_ps(0xffff, c, d));
    column[half][0] = _mm512_castpd_ps(_mm512_maskz_unpacklo_pd(0xff, ab_lo, cd_lo));
    column[half][1] = _mm512_castpd_ps(_mm512_maskz_unpackhi_pd(0xff, ab_lo, cd_lo));
    column[half][2] = _mm512_castpd_ps(_mm512_maskz_unpacklo_pd(0xff, ab_hi, cd_hi));
    column[half][3] = _mm512_castpd_ps(_mm512_maskz_unpackhi_pd(0xff, ab_hi, cd_hi));
  }
  for (int i = 0; i < 4; ++i) out[i].v = quarters<0x88>(column[0][i], column[1][i]);
  for (int i = 0; i < 3; ++i) out[4 + i].v = quarters<0xdd>(column[0][i], column[1][i]);
}
// Returns the power of two that brings x > 0 into [1, 2), a subnormal x into [2^-51, 2); for 0, 2^1023.
inline D8 inverse_power_of_two(D8 x) {
  const __m512i exponent = _mm512_and_epi64(_mm512_castpd_si512(x.v), _mm512_set1_epi64(0x7ff0000000000000));
  return {_mm512_castsi512_pd(_mm512_sub_epi64(_mm512_set1_epi64(0x7fe0000000000000), exponent))};
}
inline F16 to_float(D8 lo, D8 hi) {
  return {_mm512_maskz_insertf32x8(0xffff, _mm512_castps256_ps512(_mm512_maskz_cvtpd_ps(0xff, lo.v)),
                                   _mm512_maskz_cvtpd_ps(0xff, hi.v), 1)};
}

struct I16 {
  static constexpr int lanes = 16;
  __m512i v;
  static I16 all(int x) { return {_mm512_set1_epi32(x)}; }
  static I16 load(const int* p) { return {_mm512_loadu_si512(p)}; }
  static I16 lane_numbers() {
    return {_mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15)};
  }
  void store(int* p) const { _mm512_storeu_si512(p, v); }
};
inline I16 operator+(I16 a, I16 b) { return {_mm512_add_epi32(a.v, b.v)}; }

// Moves the lanes of `mask` to the front; what follows them is unspecified.
inline I16 compress(I16 x, int mask) { return {_mm512_maskz_compress_epi32(__mmask16(mask), x.v)}; }

}  // namespace
}  // namespace ONSET_ISA
}  // namespace onset
