// One box against eight: part of the kernel text (bvh_kernel.inl).
#pragma once

#include "base/pack8f.hpp"
#include "broadphase/bvh_kernel.hpp"

namespace onset {
namespace ONSET_KERNEL {
namespace {

constexpr int opposite(int row) { return (row + 3) % 6; }

// Supports of one box, `stride` floats apart, against a block of eight: per lane the overlap in one of six directions, the
// larger of its values at the two ends. (Inlined even into large loops: with a call, eight floats would go through memory.)
template <bool kMotion>
__attribute__((always_inline)) inline F8 overlap_along(const float* box, int stride, const float* block, int k) {
  const F8 reach = broadcast(box + opposite(k) * stride) + load(block + k * kLanes);
  if (!kMotion) return reach;
  return max(broadcast(box + (6 + opposite(k)) * stride) + load(block + (6 + k) * kLanes), reach);
}

// The smallest over the six. Negative: separated on the same side at both ends.
template <bool kMotion>
__attribute__((always_inline)) inline F8 overlap(const float* box, int stride, const float* block) {
  F8 least = overlap_along<kMotion>(box, stride, block, 0);
  for (int k = 1; k < 6; ++k) least = min(overlap_along<kMotion>(box, stride, block, k), least);
  return least;
}

// The lanes that touch on an axis where equal floats need not be equal doubles.
template <bool kMotion>
inline int touching(const float* box, int stride, const float* block, int rounded_axes) {
  int lanes = 0;
  for (int k = 0; k < 6; ++k) {
    if ((rounded_axes >> k % 3 & 1) == 0) continue;
    lanes |= mask_zero(overlap_along<kMotion>(box, stride, block, k));
  }
  return lanes;
}

// The same as `overlap` of motion boxes, and the smallest overlap at the start and at the end.
struct Reach {
  F8 at_both, at_start, at_end;
};
__attribute__((always_inline)) inline Reach reach(const float* box, int stride, const float* block) {
  Reach r{};
  for (int k = 0; k < 6; ++k) {
    const F8 s0 = broadcast(box + opposite(k) * stride) + load(block + k * kLanes);
    const F8 s1 = broadcast(box + (6 + opposite(k)) * stride) + load(block + (6 + k) * kLanes);
    r.at_both = k == 0 ? max(s0, s1) : min(max(s0, s1), r.at_both);
    r.at_start = k == 0 ? s0 : min(s0, r.at_start), r.at_end = k == 0 ? s1 : min(s1, r.at_end);
  }
  return r;
}

}  // namespace
}  // namespace ONSET_KERNEL
}  // namespace onset
