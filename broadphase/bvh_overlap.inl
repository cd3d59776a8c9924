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
__attribute__((always_inline)) inline F8 overlap(const float* box, int stride, const float* block) {
  F8 least{};
  for (int k = 0; k < 6; ++k) {
    F8 reach = broadcast(box + opposite(k) * stride) + load(block + k * kLanes);
    if (kMotion)
      reach = max(broadcast(box + (6 + opposite(k)) * stride) + load(block + (6 + k) * kLanes), reach);
    least = k == 0 ? reach : min(reach, least);
  }
  return least;
}

// Of motion boxes, by sign bits alone: negative where the boxes are apart on the same side at both ends; where they
// are apart at the start, on any side; at the end.
struct Apartness {
  F8 at_both, at_start, at_end;
};
__attribute__((always_inline)) inline Apartness apartness(const float* box, int stride, const float* block) {
  const F8 none = broadcast(0.0f);
  Apartness r{none, none, none};
  for (int k = 0; k < 6; ++k) {
    const F8 s0 = broadcast(box + opposite(k) * stride) + load(block + k * kLanes);
    const F8 s1 = broadcast(box + (6 + opposite(k)) * stride) + load(block + (6 + k) * kLanes);
    r.at_both = r.at_both | (s0 & s1), r.at_start = r.at_start | s0, r.at_end = r.at_end | s1;
  }
  return r;
}

// The lanes whose boxes overlap at neither end, or only touch there.
__attribute__((always_inline)) inline int overlapping_at_no_end(const float* box, int stride, const float* block) {
  F8 at_start{}, at_end{};
  for (int k = 0; k < 6; ++k) {
    const F8 s0 = broadcast(box + opposite(k) * stride) + load(block + k * kLanes);
    const F8 s1 = broadcast(box + (6 + opposite(k)) * stride) + load(block + (6 + k) * kLanes);
    at_start = k == 0 ? s0 : min(s0, at_start), at_end = k == 0 ? s1 : min(s1, at_end);
  }
  return mask_not_positive(at_start) & mask_not_positive(at_end);
}

}  // namespace
}  // namespace ONSET_KERNEL
}  // namespace onset
