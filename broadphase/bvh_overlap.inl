// One box against eight: part of the kernel text (bvh_kernel.inl).
#pragma once

#include "base/pack8f.hpp"
#include "broadphase/bvh_kernel.hpp"

namespace onset {
namespace ONSET_KERNEL {
namespace {

constexpr int opposite(int row) { return (row + 3) % 6; }

// Supports of one box, `stride` floats apart, against a block of eight: per lane the smallest overlap over
// the six directions, each the larger of its values at the two ends. Negative: separated on the same side at
// both ends.
template <bool kMotion>
inline F8 overlap(const float* box, int stride, const float* block) {
  F8 least{};
  for (int k = 0; k < 6; ++k) {
    F8 reach = broadcast(box + opposite(k) * stride) + load(block + k * kLanes);
    if (kMotion)
      reach = max(broadcast(box + (6 + opposite(k)) * stride) + load(block + (6 + k) * kLanes), reach);
    least = k == 0 ? reach : min(reach, least);
  }
  return least;
}

// Lanes of `mask` whose boxes only touch the lane box's, in float, on an axis where that may be due to
// rounding.
template <bool kMotion>
int touching(int mask, int rounded_axes, const float* box, const float* block) {
  int result = 0;
  for (int k = 0; k < 6; ++k) {
    if ((rounded_axes >> k % 3 & 1) == 0) continue;
    F8 reach = broadcast(box + opposite(k) * kLanes) + load(block + k * kLanes);
    if (kMotion)
      reach = max(broadcast(box + (6 + opposite(k)) * kLanes) + load(block + (6 + k) * kLanes), reach);
    result |= mask_zero(reach);
  }
  return mask & result;
}

}  // namespace
}  // namespace ONSET_KERNEL
}  // namespace onset
