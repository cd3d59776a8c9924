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
// both ends. (Inlined even into large loops: with a call, eight floats would go through memory.)
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

// The same of motion boxes, and the smallest overlap at the start and at the end.
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
