// Kernel text: one box against eight, at both ends of the motion and moving in between.
#pragma once

#include "base/simd/pack.hpp"
#include "broadphase/bvh/kernel.hpp"

namespace onset {
namespace ONSET_ISA {
namespace {

constexpr int opposite(int row) { return (row + 3) % 6; }

// Returns how far one box, its supports `stride` floats apart, overlaps each of a block along one of six
// directions, at whichever end that is more. Inlined even into large loops: a call would pass eight floats
// through memory.
template <bool kBothEnds>
__attribute__((always_inline)) inline F8 overlap_along(const float* box, int stride, const float* block,
                                                       int k) {
  const F8 reach = F8::all(box[opposite(k) * stride]) + F8::load(block + k * kLanes);
  if (!kBothEnds) return reach;
  return max(F8::all(box[(6 + opposite(k)) * stride]) + F8::load(block + (6 + k) * kLanes), reach);
}

// Returns the smallest of the six: negative where an axis separates on one side at both ends.
template <bool kBothEnds>
__attribute__((always_inline)) inline F8 overlap(const float* box, int stride, const float* block) {
  F8 least = overlap_along<kBothEnds>(box, stride, block, 0);
  for (int k = 1; k < 6; ++k) least = min(overlap_along<kBothEnds>(box, stride, block, k), least);
  return least;
}

// Returns the lanes that touch on an axis where equal floats need not be equal doubles.
template <bool kBothEnds>
inline int touching(const float* box, int stride, const float* block, int rounded_axes) {
  int lanes = 0;
  for (int k = 0; k < 6; ++k) {
    if ((rounded_axes >> k % 3 & 1) == 0) continue;
    lanes |= bits(overlap_along<kBothEnds>(box, stride, block, k) == F8::all(0));
  }
  return lanes;
}

// Sets all bits of the lanes that share a vertex. The vertices of `own` are kBlock apart.
template <int kOwn, int kOther>
__attribute__((always_inline)) inline I8 sharing(const int* own, const int* others) {
  I8 shared = I8::all(own[0]) == I8::load(others);
  for (int j = 0; j < kOwn; ++j)
    for (int k = j == 0; k < kOther; ++k)
      shared = shared | (I8::all(own[j * kBlock]) == I8::load(others + k * kBlock));
  return shared;
}

// The `overlap` of motion boxes, and the smallest overlap at the start and at the end.
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

// Boxes that are apart at both ends, on different axes, may be together in between. Floats decide here what
// leaves them no doubt, boxes_overlap in broadphase/motion_box.hpp the rest. The roots of s + e and s - e
// (error_of) bound those of the exact sums of supports through a linear FloatMap up to 11u, where u = 2^-24
// (1 + 2^-20); kRootSlack is 16u (docs/theory.md, L33), far more than the slack in double. So what is apart
// here is apart there, and what a node drops would be dropped pair by pair.

constexpr float kRootSlack = 0x1p-20f, kFourRoundings = 0x1p-22f * (1 + 0x1p-10f), kLeast = 0x1p-100f;

// The supports of two boxes in one of six directions, at both ends.
struct Direction {
  F8 a0, a1, b0, b1;
};

// When boxes may be together: from the last root of a rising overlap to the first of a falling one.
struct Together {
  F8 begin = F8::all(0.0f), end = F8::all(1.0f);

  void limit(F8 s0, F8 s1, F8 slope) {
    const F8 root = s0 * slope;
    begin = max(where_negative(s0, root, F8::all(0.0f)), begin);
    end = min(where_negative(s1, root, F8::all(1.0f)), end);
  }
};

// Returns at least 4u |a| for the exact a at either end, and more than any underflow.
inline F8 error_of(const Direction& d) {
  return F8::all(kFourRoundings) * (abs(d.a0) + abs(d.a1)) + F8::all(kLeast);
}
inline int certainly_apart(const Together& most) {
  return bits(most.begin * F8::all(1 - kRootSlack) > most.end * F8::all(1 + kRootSlack) + F8::all(kLeast));
}
inline int certainly_together(const Together& least) {
  return bits(least.end * F8::all(1 - kRootSlack) > least.begin * F8::all(1 + kRootSlack) + F8::all(kLeast));
}

// Of lanes whose boxes overlap by the test of both ends, those that are certainly apart throughout, and those
// that are not certainly together (where s - e < 0 at both ends, `least` ends where it begins).
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

// The same of eight pairs of boxes, a lane each, whose supports are eight floats apart.
inline MovingBoxes moving_boxes_apart(const float* const (&a)[kLanes], const float* const (&b)[kLanes]) {
  return moving_boxes_apart([&](int k) {
    const int across = opposite(k);
    return Direction{collect(a, across * kLanes), collect(a, (6 + across) * kLanes), collect(b, k * kLanes),
                     collect(b, (6 + k) * kLanes)};
  });
}

}  // namespace
}  // namespace ONSET_ISA
}  // namespace onset
