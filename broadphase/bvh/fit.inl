// Kernel text that makes the boxes of leaves and of the levels above.
#pragma once

#include "base/simd/pack.hpp"
#include "broadphase/bvh/kernel.hpp"

namespace onset {
namespace ONSET_ISA {
namespace {

// Writes the union of each lane's records as rows of a block; a record has a gap after each three supports.
template <bool kBothEnds>
void fit_leaf(const FitArguments& a, std::size_t n) {
  constexpr std::size_t kStride = kBoxStrideOf[kBothEnds];
  const int* members = a.members + n * unsigned(a.members_each * kBlock);
  float* out = a.tree.level[0] + n * unsigned(kRowsOf[kBothEnds] * kLanes);
  for (int end = 0; end < (kBothEnds ? 2 : 1); ++end) {
    const float* supports = a.supports + end * kLanes;
    F8 row[8];
    for (int lane = 0; lane < kLanes; ++lane) {
      row[lane] = F8::load(supports + std::size_t(members[lane]) * kStride);
      for (int k = 1; k < a.members_each; ++k)
        row[lane] = max(F8::load(supports + std::size_t(members[k * kBlock + lane]) * kStride), row[lane]);
    }
    transpose(row);
    for (int k = 0; k < 6; ++k) row[k < 3 ? k : k + 1].store(out + (end * 6 + k) * kLanes);
  }
}

}  // namespace

void fit_leaves(const FitArguments& a, std::size_t first, std::size_t last) {
  for (std::size_t n = first; n < last; ++n) a.motion ? fit_leaf<true>(a, n) : fit_leaf<false>(a, n);
}

// A lane of a level is the union of a block below: the maximum of each of its rows.
void fit_level(const TreeView& tree, int level, bool motion, std::size_t first, std::size_t last) {
  const int rows = kRowsOf[motion], stride = kBoxStrideOf[motion];
  const std::size_t size = std::size_t(rows * kLanes), below = std::size_t(tree.blocks[level - 1]);
  const float nowhere = kNowhere;
  for (std::size_t n = first; n < last; ++n) {
    F8 lanes[16];
    for (int k = 0; k < 16; ++k) lanes[k] = F8::all(nowhere);
    for (int k = 0; k < rows; ++k) {
      F8 row[8];
      for (std::size_t i = 0; i < kBlock; ++i) {
        const std::size_t child = n * kBlock + i;
        row[i] =
            child < below ? F8::load(tree.level[level - 1] + child * size + k * kLanes) : F8::all(nowhere);
      }
      transpose(row);
      for (int i = 1; i < kLanes; ++i) row[0] = max(row[0], row[i]);
      row[0].store(tree.level[level] + n * size + k * kLanes);
      lanes[k] = row[0];
    }
    for (int half = 0; half < stride / 8; ++half) {
      transpose(lanes + 8 * half);
      for (std::size_t i = 0; i < kBlock && n * kBlock + i < below; ++i)
        lanes[8 * half + int(i)].store(tree.box[level - 1] + (n * kBlock + i) * unsigned(stride) + 8 * half);
    }
  }
}

}  // namespace ONSET_ISA
}  // namespace onset
