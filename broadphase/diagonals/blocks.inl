// Kernel text: how far blocks of eight primitives extend along diagonals, and which blocks these separate.
#pragma once

#include "base/simd/pairs.hpp"
#include "broadphase/diagonals/test.inl"

namespace onset {
namespace ONSET_ISA {
namespace {

// Writes the span of block n, of primitives of kEach vertices; unused lanes have a negative id.
template <int kEach>
void write_block_span(const DiagonalPlaces& places, const int* ids, std::size_t n, float* spans) {
  const int* vertices = places.vertices + n * unsigned(kEach * kLanes);
  const F8 least = F8::all(0x1p126f), most = F8::all(-0x1p126f);
  DiagonalSpan span{least, most, least, most};
  for (std::size_t lane = 0; lane < std::size_t(kLanes); ++lane) {
    if (ids[n * std::size_t(kLanes) + lane] < 0) continue;
    const DiagonalSpan s = spanned_along_diagonals<kEach>(places.records, vertices + lane, kLanes);
    span.least_t0 = min(s.least_t0, span.least_t0), span.most_t0 = max(s.most_t0, span.most_t0);
    span.least_t1 = min(s.least_t1, span.least_t1), span.most_t1 = max(s.most_t1, span.most_t1);
  }
  float* out = spans + n * unsigned(kSpanStride);
  span.least_t0.store(out), span.most_t0.store(out + kLanes);
  span.least_t1.store(out + 2 * kLanes), span.most_t1.store(out + 3 * kLanes);
}

inline DiagonalSpan block_span(const float* spans, int block) {
  const float* s = spans + std::size_t(unsigned(block)) * unsigned(kSpanStride);
  return {F8::load(s), F8::load(s + kLanes), F8::load(s + 2 * kLanes), F8::load(s + 3 * kLanes)};
}

// Leaves those pairs of blocks in the list that no diagonal separates. The span of a block contains those of
// its primitives, and differences of floats are monotone: what is separated here would be, pair by pair, in
// float. A vertex that is far out makes its block's span reach everything.
inline void drop_separated_blocks(const float* first, const float* second, const DiagonalLimits& limits,
                                  Pairs& list) {
  const DiagonalTester test(limits);
  int left = 0;
  for (int e = 0; e < list.count; ++e) {
    const int a = list.a[e], b = list.b[e];
    list.a[left] = a, list.b[left] = b;
    left += !test(reach_along_diagonals(block_span(first, a), block_span(second, b))).apart();
  }
  list.count = left;
}

}  // namespace
}  // namespace ONSET_ISA
}  // namespace onset
