// Kernel text: boxes of leaves and of the levels above.
#pragma once

#include "base/pack8f.hpp"
#include "broadphase/bvh/kernel.hpp"

namespace onset {
namespace ONSET_ISA {
namespace {

// The union of each lane's records, turned into rows; a record has a gap after each three supports.
template <bool kBothEnds>
void fit_leaf(const FitArguments& a, std::size_t n) {
  constexpr std::size_t kStride = kBoxStrideOf[kBothEnds];
  const int* members = a.members + n * unsigned(a.members_each * kBlock);
  float* out = a.tree.level[0] + n * unsigned(kRowsOf[kBothEnds] * kLanes);
  for (int end = 0; end < (kBothEnds ? 2 : 1); ++end) {
    const float* supports = a.supports + end * kLanes;
    F8 row[8];
    for (int lane = 0; lane < kLanes; ++lane) {
      row[lane] = load(supports + std::size_t(members[lane]) * kStride);
      for (int k = 1; k < a.members_each; ++k)
        row[lane] = max(load(supports + std::size_t(members[k * kBlock + lane]) * kStride), row[lane]);
    }
    transpose(row);
    for (int k = 0; k < 6; ++k) store(out + (end * 6 + k) * kLanes, row[k < 3 ? k : k + 1]);
  }
}

}  // namespace

void fit_leaves(const FitArguments& a, std::size_t first, std::size_t last) {
  for (std::size_t n = first; n < last; ++n) a.motion ? fit_leaf<true>(a, n) : fit_leaf<false>(a, n);
}

// The union of a block below is the maximum of each of its rows.
void fit_level(const TreeView& tree, int level, bool motion, std::size_t first, std::size_t last) {
  const int rows = kRowsOf[motion], stride = kBoxStrideOf[motion];
  const std::size_t size = std::size_t(rows * kLanes), below = std::size_t(tree.blocks[level - 1]);
  const float nowhere = kNowhere;
  for (std::size_t n = first; n < last; ++n) {
    F8 lanes[16];
    for (int k = 0; k < 16; ++k) lanes[k] = broadcast(&nowhere);
    for (int k = 0; k < rows; ++k) {
      F8 row[8];
      for (std::size_t i = 0; i < kBlock; ++i) {
        const std::size_t child = n * kBlock + i;
        row[i] =
            child < below ? load(tree.level[level - 1] + child * size + k * kLanes) : broadcast(&nowhere);
      }
      transpose(row);
      for (int i = 1; i < kLanes; ++i) row[0] = max(row[0], row[i]);
      store(tree.level[level] + n * size + k * kLanes, row[0]);
      lanes[k] = row[0];
    }
    for (int half = 0; half < stride / 8; ++half) {
      transpose(lanes + 8 * half);
      for (std::size_t i = 0; i < kBlock && n * kBlock + i < below; ++i)
        store(tree.box[level - 1] + (n * kBlock + i) * unsigned(stride) + 8 * half, lanes[8 * half + int(i)]);
    }
  }
}

}  // namespace ONSET_ISA
}  // namespace onset
