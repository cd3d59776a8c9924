// Eight floats or eight ints side by side, for kernels whose text is compiled once per instruction set.
//
// Include it from a kernel's own translation unit after defining ONSET_KERNEL, and __AVX2__ where that
// unit is compiled for AVX2. Everything has internal linkage, so that no copy compiled for AVX2 is ever
// shared.
#pragma once

#ifdef __AVX2__
#include <immintrin.h>
#endif

namespace onset {
namespace ONSET_KERNEL {
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
inline void store(float* p, F8 x) { _mm256_storeu_ps(p, x.v); }
inline F8 operator+(F8 a, F8 b) { return {_mm256_add_ps(a.v, b.v)}; }
inline F8 min(F8 a, F8 b) { return {_mm256_min_ps(a.v, b.v)}; }
inline F8 max(F8 a, F8 b) { return {_mm256_max_ps(a.v, b.v)}; }
inline int mask_not_negative(F8 a) { return ~_mm256_movemask_ps(a.v) & 0xff; }  // by the sign bit
inline int mask_neither_negative(F8 a, I8 b) {  // neither sign bit set, -0.0 counts as negative
  return ~_mm256_movemask_ps(_mm256_or_ps(a.v, _mm256_castsi256_ps(b.v))) & 0xff;
}
inline int mask_zero(F8 a) { return _mm256_movemask_ps(_mm256_cmp_ps(a.v, _mm256_setzero_ps(), _CMP_EQ_OQ)); }

inline I8 load(const int* p) { return {_mm256_loadu_si256(reinterpret_cast<const __m256i*>(p))}; }
inline I8 broadcast(int x) { return {_mm256_set1_epi32(x)}; }
inline void store(int* p, I8 x) { _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), x.v); }
inline I8 operator+(I8 a, I8 b) { return {_mm256_add_epi32(a.v, b.v)}; }
inline I8 min(I8 a, I8 b) { return {_mm256_min_epi32(a.v, b.v)}; }
inline I8 max(I8 a, I8 b) { return {_mm256_max_epi32(a.v, b.v)}; }
inline I8 operator|(I8 a, I8 b) { return {_mm256_or_si256(a.v, b.v)}; }
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
inline void transpose(F8* x) {
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

struct F8 {
  float v[8];
};
struct I8 {
  int v[8];
};

// The loops below are what the compiler turns into the vector instructions every machine of the target has.
#define ONSET_EACH(type, expression)               \
  type r;                                          \
  for (int i = 0; i < 8; ++i) r.v[i] = expression; \
  return r
#define ONSET_MASK(condition)                           \
  int r = 0;                                            \
  for (int i = 0; i < 8; ++i) r |= int(condition) << i; \
  return r

inline F8 load(const float* p) { ONSET_EACH(F8, p[i]); }
inline F8 broadcast(const float* p) { ONSET_EACH(F8, *p); }
inline void store(float* p, F8 x) {
  for (int i = 0; i < 8; ++i) p[i] = x.v[i];
}
inline F8 operator+(F8 a, F8 b) { ONSET_EACH(F8, a.v[i] + b.v[i]); }
inline F8 min(F8 a, F8 b) { ONSET_EACH(F8, a.v[i] < b.v[i] ? a.v[i] : b.v[i]); }
inline F8 max(F8 a, F8 b) { ONSET_EACH(F8, a.v[i] > b.v[i] ? a.v[i] : b.v[i]); }
inline int mask_not_negative(F8 a) { ONSET_MASK(!__builtin_signbit(a.v[i])); }
inline int mask_neither_negative(F8 a, I8 b) { ONSET_MASK(!__builtin_signbit(a.v[i]) && b.v[i] >= 0); }
inline int mask_zero(F8 a) { ONSET_MASK(a.v[i] == 0); }

inline I8 load(const int* p) { ONSET_EACH(I8, p[i]); }
inline I8 broadcast(int x) { ONSET_EACH(I8, x); }
inline void store(int* p, I8 x) {
  for (int i = 0; i < 8; ++i) p[i] = x.v[i];
}
inline I8 operator+(I8 a, I8 b) { ONSET_EACH(I8, a.v[i] + b.v[i]); }
inline I8 min(I8 a, I8 b) { ONSET_EACH(I8, a.v[i] < b.v[i] ? a.v[i] : b.v[i]); }
inline I8 max(I8 a, I8 b) { ONSET_EACH(I8, a.v[i] > b.v[i] ? a.v[i] : b.v[i]); }
inline I8 operator|(I8 a, I8 b) { ONSET_EACH(I8, a.v[i] | b.v[i]); }
inline I8 operator==(I8 a, I8 b) { ONSET_EACH(I8, -int(a.v[i] == b.v[i])); }  // all bits of a lane
inline int mask_true(I8 a) { ONSET_MASK(a.v[i] < 0); }
inline I8 lane_numbers() { return {{0, 1, 2, 3, 4, 5, 6, 7}}; }

inline I8 compress(I8 x, int mask) { ONSET_EACH(I8, x.v[kLaneTable.lane[mask][i]]); }

inline void store_interleaved(int* p, I8 a, I8 b) {
  for (int i = 0; i < 8; ++i) p[2 * i] = a.v[i], p[2 * i + 1] = b.v[i];
}

inline void transpose(F8* x) {
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < i; ++j) {
      const float t = x[i].v[j];
      x[i].v[j] = x[j].v[i];
      x[j].v[i] = t;
    }
}

#undef ONSET_EACH
#undef ONSET_MASK

#endif

}  // namespace
}  // namespace ONSET_KERNEL
}  // namespace onset
