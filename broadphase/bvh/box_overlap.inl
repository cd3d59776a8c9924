// Kernel text: one box against eight, at both ends of the motion and moving in between.
#pragma once

#include "base/simd/pack.hpp"
#include "broadphase/bvh/kernel.hpp"

namespace onset {
namespace ONSET_ISA {
namespace {

constexpr int opposite(int row) { return (row + 3) % 6; }

// Supports of one box, `stride` floats apart, against a block of eight: per lane the overlap in one of six directions, the
// larger of its values at the two ends. (Inlined even into large loops: with a call, eight floats would go through memory.)
template <bool kBothEnds>
__attribute__((always_inline)) inline F8 overlap_along(const float* box, int stride, const float* block, int k) {
  const F8 reach = F8::all(box[opposite(k) * stride]) + F8::load(block + k * kLanes);
  if (!kBothEnds) return reach;
  return max(F8::all(box[(6 + opposite(k)) * stride]) + F8::load(block + (6 + k) * kLanes), reach);
}

// The smallest over the six. Negative: separated on the same side at both ends.
template <bool kBothEnds>
__attribute__((always_inline)) inline F8 overlap(const float* box, int stride, const float* block) {
  F8 least = overlap_along<kBothEnds>(box, stride, block, 0);
  for (int k = 1; k < 6; ++k) least = min(overlap_along<kBothEnds>(box, stride, block, k), least);
  return least;
}

// The lanes that touch on an axis where equal floats need not be equal doubles.
template <bool kBothEnds>
inline int touching(const float* box, int stride, const float* block, int rounded_axes) {
  int lanes = 0;
  for (int k = 0; k < 6; ++k) {
    if ((rounded_axes >> k % 3 & 1) == 0) continue;
    lanes |= bits(overlap_along<kBothEnds>(box, stride, block, k) == F8::all(0));
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
    const F8 s0 = F8::all(box[opposite(k) * stride]) + F8::load(block + k * kLanes);
    const F8 s1 = F8::all(box[(6 + opposite(k)) * stride]) + F8::load(block + (6 + k) * kLanes);
    r.at_both = k == 0 ? max(s0, s1) : min(max(s0, s1), r.at_both);
    r.at_start = k == 0 ? s0 : min(s0, r.at_start), r.at_end = k == 0 ? s1 : min(s1, r.at_end);
  }
  return r;
}

// Boxes that are apart at both ends, on different axes, may be together in between, or not: boxes_overlap in
// motion_box.hpp decides in double, from when the last axis lets them meet and when the first parts them.
// Here it is decided in float where that leaves no doubt. A support y of a linear FloatMap is within u |Y| of
// the Y it stands for, u = 2^-24 (1 + 2^-20), and |Yb| <= |Ya| + |S| for a sum S = Ya + Yb: s = fl(ya + yb) is
// within 2u (|Ya| + |S|) of it. With e >= 4u |Ya|, S <= (s + e)(1 + 2u) where s + e > 0, S <= (s + e)(1 - 2u)
// else: a root of s + e is that of an upper bound of S up to a factor within 1 +- 6u, and errs by 5u more as
// computed; kRootSlack is 16u. s - e is a lower bound likewise. What is apart here is so in double, whose slack
// is less; a node's supports are at least those of what it holds, so what it drops would be dropped pair by
// pair.

constexpr float kRootSlack = 0x1p-20f, kFourRoundings = 0x1p-22f * (1 + 0x1p-10f), kLeast = 0x1p-100f;

// One of the six directions: supports of two boxes at both ends.
struct Direction {
  F8 a0, a1, b0, b1;
};

// When boxes may be together: from the last root of a rising reach to the first of a falling one.
struct Together {
  F8 begin = F8::all(0.0f), end = F8::all(1.0f);

  void limit(F8 s0, F8 s1, F8 slope) {
    const F8 root = s0 * slope;
    begin = max(where_negative(s0, root, F8::all(0.0f)), begin);
    end = min(where_negative(s1, root, F8::all(1.0f)), end);
  }
};

// 4u |Ya| at either end, and more than any underflow.
inline F8 error_of(const Direction& d) {
  return F8::all(kFourRoundings) * (abs(d.a0) + abs(d.a1)) + F8::all(kLeast);
}
inline int certainly_apart(const Together& most) {
  return bits(most.begin * F8::all(1 - kRootSlack) >
              most.end * F8::all(1 + kRootSlack) + F8::all(kLeast));
}
inline int certainly_together(const Together& least) {
  return bits(least.end * F8::all(1 - kRootSlack) >
              least.begin * F8::all(1 + kRootSlack) + F8::all(kLeast));
}

// The lanes whose boxes are certainly apart throughout, of those that are not so on one axis at both ends; and those for
// which float leaves it open, among them all that may be apart on one axis at both ends: `least` then ends where it begins.
struct MovingBoxes {
  int apart, unsure;
};
template <class Directions>
inline MovingBoxes moving_boxes_apart(const Directions& directions) {
  Together most, least;
  for (int k = 0; k < 6; ++k) {
    const Direction d = directions(k);
    const F8 s0 = d.a0 + d.b0, s1 = d.a1 + d.b1, e = error_of(d), slope = F8::all(1.0f) / (s0 - s1);
    most.limit(s0 + e, s1 + e, slope);
    least.limit(s0 - e, s1 - e, slope);
  }
  return {certainly_apart(most), ~certainly_together(least)};
}

}  // namespace
}  // namespace ONSET_ISA
}  // namespace onset
