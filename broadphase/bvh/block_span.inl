// Kernel text: how far blocks of edges extend along diagonals, and which blocks these separate.
#pragma once

#include "base/simd/pairs.hpp"
#include "broadphase/bvh/kernel.hpp"
#include "broadphase/diagonals/test.inl"

namespace onset {
namespace ONSET_ISA {
namespace {

inline constexpr std::size_t kSpanStride = 4 * kLanes;

inline DiagonalSpan block_span(const TreeView& tree, int block) {
  const float* s = tree.spans + std::size_t(unsigned(block)) * kSpanStride;
  return {F8::load(s), F8::load(s + kLanes), F8::load(s + 2 * kLanes), F8::load(s + 3 * kLanes)};
}

// Leaves those pairs of leaf blocks in the list that no diagonal separates. The span of a block contains those
// of its edges, and differences of floats are monotone: what is separated here would be pair by pair, in float,
// and a vertex that is far out is within every span.
inline void drop_separated_blocks(const TreeView& query, const TreeView& tree, const DiagonalLimits& limits,
                                  Pairs& list) {
  const DiagonalTester test(limits);
  int left = 0;
  for (int e = 0; e < list.count; ++e) {
    const int a = list.a[e], b = list.b[e];
    list.a[left] = a, list.b[left] = b;
    left += !test(reach_along_diagonals(block_span(query, a), block_span(tree, b))).apart();
  }
  list.count = left;
}

}  // namespace

void fit_spans(const TreeView& tree, std::size_t first, std::size_t last) {
  constexpr std::size_t kEach = 2;
  for (std::size_t n = first; n < last; ++n) {
    const int* vertices = tree.diagonals.vertices + n * (kEach * kBlock);
    const F8 nowhere = F8::all(kNowhere), beyond = F8::all(-kNowhere);
    DiagonalSpan span{beyond, nowhere, beyond, nowhere};
    for (std::size_t lane = 0; lane < kBlock; ++lane) {
      if (tree.ids[n * kBlock + lane] < 0) continue;
      const DiagonalSpan s = spanned_along_diagonals<kEach>(tree.diagonals.records, vertices + lane, kBlock);
      span.least_t0 = min(s.least_t0, span.least_t0), span.most_t0 = max(s.most_t0, span.most_t0);
      span.least_t1 = min(s.least_t1, span.least_t1), span.most_t1 = max(s.most_t1, span.most_t1);
    }
    float* out = tree.spans + n * kSpanStride;
    span.least_t0.store(out), span.most_t0.store(out + kLanes);
    span.least_t1.store(out + 2 * kLanes), span.most_t1.store(out + 3 * kLanes);
  }
}

}  // namespace ONSET_ISA
}  // namespace onset
