// Lanes of numbers, as the kernels see them: F8 (eight floats) and D4 (four doubles), each with its mask.
//
// A kernel text includes this inside a translation unit that defines ONSET_ISA as its namespace; with AVX2 enabled there
// the packs are registers, else plain arrays. Both give the same bits for every input: only IEEE + - * / sqrt, comparisons
// and bit operations are used, min and max are `a < b ? a : b` and `a > b ? a : b` (the second operand wins on NaN or
// equality, as vminpd does), and nothing is contracted (-ffp-contract=off). Never include it where ONSET_ISA could be
// shared by two instruction sets: the linker would keep one copy of each inline function.
#pragma once

#ifndef ONSET_ISA
#error "define ONSET_ISA, the namespace of this instruction set's copy, before including base/pack.hpp"
#endif

#if defined(__AVX2__)
#include <immintrin.h>
#endif

namespace onset::ONSET_ISA {

#if defined(__AVX2__)

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

// x, y, z of the four points at p0..p3 (four doubles each), one point a lane.
inline void transpose(const double* p0, const double* p1, const double* p2, const double* p3, D4 (&xyz)[3]) {
  const __m256d a = _mm256_loadu_pd(p0), b = _mm256_loadu_pd(p1), c = _mm256_loadu_pd(p2), d = _mm256_loadu_pd(p3);
  const __m256d ab_lo = _mm256_unpacklo_pd(a, b), ab_hi = _mm256_unpackhi_pd(a, b);
  const __m256d cd_lo = _mm256_unpacklo_pd(c, d), cd_hi = _mm256_unpackhi_pd(c, d);
  xyz[0].v = _mm256_permute2f128_pd(ab_lo, cd_lo, 0x20);
  xyz[1].v = _mm256_permute2f128_pd(ab_hi, cd_hi, 0x20);
  xyz[2].v = _mm256_permute2f128_pd(ab_lo, cd_lo, 0x31);
}
// The first seven of the eight floats at each p[l], one p a lane.
inline void transpose(const float* const (&p)[8], F8 (&out)[7]) {
  const auto both = [&](int l, int at) {  // four floats of lane l and of lane l + 4
    return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(p[l] + at)), _mm_loadu_ps(p[l + 4] + at), 1);
  };
  for (int half = 0; half < 2; ++half) {
    const __m256 a = both(0, 4 * half), b = both(1, 4 * half), c = both(2, 4 * half), d = both(3, 4 * half);
    const __m256d ab_lo = _mm256_castps_pd(_mm256_unpacklo_ps(a, b)), cd_lo = _mm256_castps_pd(_mm256_unpacklo_ps(c, d));
    const __m256d ab_hi = _mm256_castps_pd(_mm256_unpackhi_ps(a, b)), cd_hi = _mm256_castps_pd(_mm256_unpackhi_ps(c, d));
    out[4 * half].v = _mm256_castpd_ps(_mm256_unpacklo_pd(ab_lo, cd_lo));
    out[4 * half + 1].v = _mm256_castpd_ps(_mm256_unpackhi_pd(ab_lo, cd_lo));
    out[4 * half + 2].v = _mm256_castpd_ps(_mm256_unpacklo_pd(ab_hi, cd_hi));
    if (half == 0) out[3].v = _mm256_castpd_ps(_mm256_unpackhi_pd(ab_hi, cd_hi));
  }
}
// The power of two that brings a positive x into [1, 2) (a subnormal x: into [2^-51, 2); 0 gives 2^1023).
inline D4 inverse_power_of_two(D4 x) {
  const __m256i exponent = _mm256_and_si256(_mm256_castpd_si256(x.v), _mm256_set1_epi64x(0x7ff0000000000000));
  return {_mm256_castsi256_pd(_mm256_sub_epi64(_mm256_set1_epi64x(0x7fe0000000000000), exponent))};
}
inline F8 to_float(D4 lo, D4 hi) {
  return {_mm256_insertf128_ps(_mm256_castps128_ps256(_mm256_cvtpd_ps(lo.v)), _mm256_cvtpd_ps(hi.v), 1)};
}

#else

template <int N>
struct LaneMask {
  bool m[N];
};
template <class T, int N>
struct Lanes {
  using Scalar = T;
  using Mask = LaneMask<N>;
  static constexpr int lanes = N;
  T v[N];
  static Lanes all(T x) {
    Lanes r;
    for (int i = 0; i < N; ++i) r.v[i] = x;
    return r;
  }
  static Lanes load(const T* p) {
    Lanes r;
    for (int i = 0; i < N; ++i) r.v[i] = p[i];
    return r;
  }
  void store(T* p) const {
    for (int i = 0; i < N; ++i) p[i] = v[i];
  }
};

#define ONSET_LANES(signature, expression)        \
  template <class T, int N>                       \
  inline Lanes<T, N> signature {                  \
    Lanes<T, N> r;                                \
    for (int i = 0; i < N; ++i) r.v[i] = expression; \
    return r;                                     \
  }
#define ONSET_COMPARE(op)                                          \
  template <class T, int N>                                        \
  inline LaneMask<N> operator op(const Lanes<T, N>& a, const Lanes<T, N>& b) { \
    LaneMask<N> r;                                                 \
    for (int i = 0; i < N; ++i) r.m[i] = a.v[i] op b.v[i];         \
    return r;                                                      \
  }
inline double root(double x) { return __builtin_sqrt(x); }
inline float root(float x) { return __builtin_sqrtf(x); }
inline double magnitude(double x) { return __builtin_fabs(x); }
inline float magnitude(float x) { return __builtin_fabsf(x); }
#define ONSET_L const Lanes<T, N>&
ONSET_LANES(operator+(ONSET_L a, ONSET_L b), a.v[i] + b.v[i])
ONSET_LANES(operator-(ONSET_L a, ONSET_L b), a.v[i] - b.v[i])
ONSET_LANES(operator*(ONSET_L a, ONSET_L b), a.v[i] * b.v[i])
ONSET_LANES(operator/(ONSET_L a, ONSET_L b), a.v[i] / b.v[i])
ONSET_LANES(sqrt(ONSET_L a), root(a.v[i]))
ONSET_LANES(min(ONSET_L a, ONSET_L b), a.v[i] < b.v[i] ? a.v[i] : b.v[i])
ONSET_LANES(max(ONSET_L a, ONSET_L b), a.v[i] > b.v[i] ? a.v[i] : b.v[i])
ONSET_LANES(abs(ONSET_L a), magnitude(a.v[i]))
ONSET_COMPARE(<)
ONSET_COMPARE(<=)
ONSET_COMPARE(>)
ONSET_COMPARE(>=)
ONSET_COMPARE(==)
#undef ONSET_L
#undef ONSET_COMPARE
#undef ONSET_LANES
template <int N>
inline LaneMask<N> operator&(const LaneMask<N>& a, const LaneMask<N>& b) {
  LaneMask<N> r;
  for (int i = 0; i < N; ++i) r.m[i] = a.m[i] & b.m[i];
  return r;
}
template <int N>
inline LaneMask<N> operator|(const LaneMask<N>& a, const LaneMask<N>& b) {
  LaneMask<N> r;
  for (int i = 0; i < N; ++i) r.m[i] = a.m[i] | b.m[i];
  return r;
}
template <class T, int N>
inline Lanes<T, N> select(const LaneMask<N>& m, const Lanes<T, N>& a, const Lanes<T, N>& b) {
  Lanes<T, N> r;
  for (int i = 0; i < N; ++i) r.v[i] = m.m[i] ? a.v[i] : b.v[i];
  return r;
}
template <int N>
inline int bits(const LaneMask<N>& m) {
  int r = 0;
  for (int i = 0; i < N; ++i) r |= int(m.m[i]) << i;
  return r;
}
using D4 = Lanes<double, 4>;
using F8 = Lanes<float, 8>;

inline void transpose(const double* p0, const double* p1, const double* p2, const double* p3, D4 (&xyz)[3]) {
  for (int a = 0; a < 3; ++a) xyz[a].v[0] = p0[a], xyz[a].v[1] = p1[a], xyz[a].v[2] = p2[a], xyz[a].v[3] = p3[a];
}
inline D4 inverse_power_of_two(D4 x) {
  D4 r;
  for (int i = 0; i < 4; ++i) {
    unsigned long long b;
    __builtin_memcpy(&b, &x.v[i], 8);
    b = 0x7fe0000000000000 - (b & 0x7ff0000000000000);
    __builtin_memcpy(&r.v[i], &b, 8);
  }
  return r;
}
inline void transpose(const float* const (&p)[8], F8 (&out)[7]) {
  for (int i = 0; i < 7; ++i)
    for (int l = 0; l < 8; ++l) out[i].v[l] = p[l][i];
}
inline F8 to_float(const D4& lo, const D4& hi) {
  F8 r;
  for (int i = 0; i < 4; ++i) r.v[i] = static_cast<float>(lo.v[i]), r.v[4 + i] = static_cast<float>(hi.v[i]);
  return r;
}

#endif

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

}  // namespace onset::ONSET_ISA
