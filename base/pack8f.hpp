// Eight floats or eight ints side by side, for kernels whose text is compiled once per instruction set.
//
// Include it from a kernel's own translation unit after defining ONSET_ISA, and __AVX2__ where that
// unit is compiled for AVX2. Everything has internal linkage, so that no copy compiled for AVX2 is ever
// shared.
#pragma once

#ifdef __AVX2__
#include <immintrin.h>
#endif

namespace onset {
namespace ONSET_ISA {
namespace {

constexpr int kLanes = 8;

// Masks are plain ints, bit i for lane i.
inline int lowest_lane(int mask) { return __builtin_ctz(unsigned(mask)); }
inline int count_lanes(int mask) { return __builtin_popcount(unsigned(mask)); }

// For each mask, its lanes in ascending order.
struct LaneTable {
  unsigned char lane[256][8];
};
constexpr LaneTable make_lane_table() {
  LaneTable table{};
  for (int mask = 0; mask < 256; ++mask)
    for (int lane = 0, place = 0; lane < 8; ++lane)
      if (mask >> lane & 1) table.lane[mask][place++] = static_cast<unsigned char>(lane);
  return table;
}
constexpr LaneTable kLaneTable = make_lane_table();

#ifdef __AVX2__

struct F8 {
  __m256 v;
};
struct I8 {
  __m256i v;
};

inline F8 load(const float* p) { return {_mm256_loadu_ps(p)}; }
inline F8 broadcast(const float* p) { return {_mm256_broadcast_ss(p)}; }
__attribute__((always_inline)) inline F8 collect(const float* const* p, int i) {  // lane l: p[l][i]
  return {_mm256_setr_ps(p[0][i], p[1][i], p[2][i], p[3][i], p[4][i], p[5][i], p[6][i], p[7][i])};
}
inline void store(float* p, F8 x) { _mm256_storeu_ps(p, x.v); }
inline F8 broadcast(float x) { return {_mm256_set1_ps(x)}; }
inline F8 operator+(F8 a, F8 b) { return {_mm256_add_ps(a.v, b.v)}; }
inline F8 operator-(F8 a, F8 b) { return {_mm256_sub_ps(a.v, b.v)}; }
inline F8 operator*(F8 a, F8 b) { return {_mm256_mul_ps(a.v, b.v)}; }
inline F8 operator/(F8 a, F8 b) { return {_mm256_div_ps(a.v, b.v)}; }
inline F8 operator&(F8 a, F8 b) { return {_mm256_and_ps(a.v, b.v)}; }  // of bits
inline F8 operator|(F8 a, F8 b) { return {_mm256_or_ps(a.v, b.v)}; }
inline F8 abs(F8 a) { return {_mm256_andnot_ps(_mm256_set1_ps(-0.0f), a.v)}; }
inline F8 where_negative(F8 sign, F8 a, F8 b) { return {_mm256_blendv_ps(b.v, a.v, sign.v)}; }  // a there, else b
inline F8 min(F8 a, F8 b) { return {_mm256_min_ps(a.v, b.v)}; }
inline F8 max(F8 a, F8 b) { return {_mm256_max_ps(a.v, b.v)}; }
inline int mask_not_negative(F8 a) { return ~_mm256_movemask_ps(a.v) & 0xff; }  // by the sign bit
inline int mask_neither_negative(F8 a, I8 b) {  // neither sign bit set, -0.0 counts as negative
  return ~_mm256_movemask_ps(_mm256_or_ps(a.v, _mm256_castsi256_ps(b.v))) & 0xff;
}
inline int mask_zero(F8 a) { return _mm256_movemask_ps(_mm256_cmp_ps(a.v, _mm256_setzero_ps(), _CMP_EQ_OQ)); }
inline int mask_negative(F8 a) { return _mm256_movemask_ps(a.v); }  // by the sign bit
inline int mask_not_positive(F8 a) { return _mm256_movemask_ps(_mm256_cmp_ps(a.v, _mm256_setzero_ps(), _CMP_LE_OQ)); }
inline int mask_greater(F8 a, F8 b) { return _mm256_movemask_ps(_mm256_cmp_ps(a.v, b.v, _CMP_GT_OQ)); }

inline I8 load(const int* p) { return {_mm256_loadu_si256(reinterpret_cast<const __m256i*>(p))}; }
inline I8 broadcast(int x) { return {_mm256_set1_epi32(x)}; }
inline void store(int* p, I8 x) { _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), x.v); }
inline I8 operator+(I8 a, I8 b) { return {_mm256_add_epi32(a.v, b.v)}; }
inline I8 min(I8 a, I8 b) { return {_mm256_min_epi32(a.v, b.v)}; }
inline I8 max(I8 a, I8 b) { return {_mm256_max_epi32(a.v, b.v)}; }
inline I8 operator|(I8 a, I8 b) { return {_mm256_or_si256(a.v, b.v)}; }
inline I8 operator&(I8 a, I8 b) { return {_mm256_and_si256(a.v, b.v)}; }
inline I8 operator==(I8 a, I8 b) { return {_mm256_cmpeq_epi32(a.v, b.v)}; }  // all bits of a lane
inline int mask_true(I8 a) { return _mm256_movemask_ps(_mm256_castsi256_ps(a.v)); }
inline I8 lane_numbers() { return {_mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7)}; }

// The lanes of `mask` moved to the front; what follows them is unspecified.
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

// x[i] lane j <- x[j] lane i, for 8 packs.
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

#else

// Two halves of four, in the vector types of GCC and Clang: SSE2 on every x86-64, NEON on Arm, plain code
// elsewhere.
typedef float Float4 __attribute__((vector_size(16)));
typedef int Int4 __attribute__((vector_size(16)));

struct F8 {
  Float4 lo, hi;
};
struct I8 {
  Int4 lo, hi;
};

template <class Half, class T>
inline Half load_half(const T* p) {
  Half h;
  __builtin_memcpy(&h, p, sizeof h);
  return h;
}
inline int sign_bits(Int4 x) {
#ifdef __SSE2__
  return __builtin_ia32_movmskps((Float4)x);
#else
  const Int4 bits = (x < 0) & Int4{1, 2, 4, 8};
  return (bits[0] | bits[1]) | (bits[2] | bits[3]);
#endif
}

inline F8 load(const float* p) { return {load_half<Float4>(p), load_half<Float4>(p + 4)}; }
inline F8 broadcast(const float* p) {
  const Float4 x{*p, *p, *p, *p};
  return {x, x};
}
__attribute__((always_inline)) inline F8 collect(const float* const* p, int i) {  // lane l: p[l][i]
  return {Float4{p[0][i], p[1][i], p[2][i], p[3][i]}, Float4{p[4][i], p[5][i], p[6][i], p[7][i]}};
}
inline void store(float* p, F8 x) { __builtin_memcpy(p, &x, sizeof x); }
inline F8 broadcast(float x) { return broadcast(&x); }
inline F8 operator+(F8 a, F8 b) { return {a.lo + b.lo, a.hi + b.hi}; }
inline F8 operator-(F8 a, F8 b) { return {a.lo - b.lo, a.hi - b.hi}; }
inline F8 operator*(F8 a, F8 b) { return {a.lo * b.lo, a.hi * b.hi}; }
inline F8 operator/(F8 a, F8 b) { return {a.lo / b.lo, a.hi / b.hi}; }
inline F8 operator&(F8 a, F8 b) {  // of bits
  return {(Float4)((Int4)a.lo & (Int4)b.lo), (Float4)((Int4)a.hi & (Int4)b.hi)};
}
inline F8 operator|(F8 a, F8 b) {
  return {(Float4)((Int4)a.lo | (Int4)b.lo), (Float4)((Int4)a.hi | (Int4)b.hi)};
}
inline F8 abs(F8 a) { return {(Float4)((Int4)a.lo & 0x7fffffff), (Float4)((Int4)a.hi & 0x7fffffff)}; }
inline F8 where_negative(F8 sign, F8 a, F8 b) {  // a there, else b
  return {(Int4)sign.lo < 0 ? a.lo : b.lo, (Int4)sign.hi < 0 ? a.hi : b.hi};
}
inline F8 min(F8 a, F8 b) { return {a.lo < b.lo ? a.lo : b.lo, a.hi < b.hi ? a.hi : b.hi}; }
inline F8 max(F8 a, F8 b) { return {a.lo > b.lo ? a.lo : b.lo, a.hi > b.hi ? a.hi : b.hi}; }

inline I8 load(const int* p) { return {load_half<Int4>(p), load_half<Int4>(p + 4)}; }
inline I8 broadcast(int x) { return {Int4{x, x, x, x}, Int4{x, x, x, x}}; }
inline void store(int* p, I8 x) { __builtin_memcpy(p, &x, sizeof x); }
inline I8 operator+(I8 a, I8 b) { return {a.lo + b.lo, a.hi + b.hi}; }
inline I8 min(I8 a, I8 b) { return {a.lo < b.lo ? a.lo : b.lo, a.hi < b.hi ? a.hi : b.hi}; }
inline I8 max(I8 a, I8 b) { return {a.lo > b.lo ? a.lo : b.lo, a.hi > b.hi ? a.hi : b.hi}; }
inline I8 operator|(I8 a, I8 b) { return {a.lo | b.lo, a.hi | b.hi}; }
inline I8 operator&(I8 a, I8 b) { return {a.lo & b.lo, a.hi & b.hi}; }
inline I8 operator==(I8 a, I8 b) { return {a.lo == b.lo, a.hi == b.hi}; }  // all bits of a lane
inline I8 lane_numbers() { return {Int4{0, 1, 2, 3}, Int4{4, 5, 6, 7}}; }

inline int mask_true(I8 a) { return sign_bits(a.lo) | sign_bits(a.hi) << 4; }
inline int mask_neither_negative(F8 a, I8 b) {  // neither sign bit set, -0.0 counts as negative
  return ~mask_true({(Int4)a.lo | b.lo, (Int4)a.hi | b.hi}) & 0xff;
}
inline int mask_not_negative(F8 a) { return ~mask_true({(Int4)a.lo, (Int4)a.hi}) & 0xff; }
inline int mask_zero(F8 a) { return mask_true({a.lo == 0, a.hi == 0}); }
inline int mask_negative(F8 a) { return mask_true({(Int4)a.lo, (Int4)a.hi}); }  // by the sign bit
inline int mask_not_positive(F8 a) { return mask_true({a.lo <= 0, a.hi <= 0}); }
inline int mask_greater(F8 a, F8 b) { return mask_true({a.lo > b.lo, a.hi > b.hi}); }

inline I8 compress(I8 x, int mask) {
  int from[8], to[8];
  store(from, x);
  for (int i = 0; i < 8; ++i) to[i] = from[kLaneTable.lane[mask][i]];
  return load(to);
}

inline void store_interleaved(int* p, I8 a, I8 b) {
  int as[8], bs[8];
  store(as, a), store(bs, b);
  for (int i = 0; i < 8; ++i) p[2 * i] = as[i], p[2 * i + 1] = bs[i];
}

__attribute__((always_inline)) inline void transpose(F8* x) {
  float from[8][8];
  for (int i = 0; i < 8; ++i) store(from[i], x[i]);
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j) {
      Float4& half = j < 4 ? x[i].lo : x[i].hi;
      half[j % 4] = from[j][i];
    }
}

#endif

}  // namespace
}  // namespace ONSET_ISA
}  // namespace onset
