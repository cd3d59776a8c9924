// Boxes that pass one another: part of the kernel text (bvh_kernel.inl).
//
// Boxes that are apart at both ends, on different axes, may be together in between, or not: boxes_pass in
// motion_box.hpp decides in double, from when the last axis lets them meet and when the first parts them.
// Here it is decided in float where that leaves no doubt. A support y of a linear FloatMap is within u |Y| of
// the Y it stands for, u = 2^-24 (1 + 2^-20), and |Yb| <= |Ya| + |S| for a sum S = Ya + Yb: s = fl(ya + yb) is
// within 2u (|Ya| + |S|) of it. With e >= 4u |Ya|, S <= (s + e)(1 + 2u) where s + e > 0, S <= (s + e)(1 - 2u)
// else: a root of s + e is that of an upper bound of S up to a factor within 1 +- 6u, and errs by 5u more as
// computed; kRootSlack is 16u. s - e is a lower bound likewise. What is apart here is so in double, whose slack
// is less; a node's supports are at least those of what it holds, so what it drops would be dropped pair by
// pair.
#pragma once

#include "broadphase/bvh_overlap.inl"

namespace onset {
namespace ONSET_KERNEL {
namespace {

constexpr float kRootSlack = 0x1p-20f, kFourRoundings = 0x1p-22f * (1 + 0x1p-10f), kLeast = 0x1p-100f;

// One of the six directions: supports of two boxes at both ends.
struct Direction {
  F8 a0, a1, b0, b1;
};

// When boxes may be together: from the last root of a rising reach to the first of a falling one.
struct Together {
  F8 begin = broadcast(0.0f), end = broadcast(1.0f);

  void limit(F8 s0, F8 s1, F8 slope) {
    const F8 root = s0 * slope;
    begin = max(where_negative(s0, root, broadcast(0.0f)), begin);
    end = min(where_negative(s1, root, broadcast(1.0f)), end);
  }
};

// 4u |Ya| at either end, and more than any underflow.
inline F8 error_of(const Direction& d) {
  return broadcast(kFourRoundings) * (abs(d.a0) + abs(d.a1)) + broadcast(kLeast);
}
inline int certainly_apart(const Together& most) {
  return mask_greater(most.begin * broadcast(1 - kRootSlack),
                      most.end * broadcast(1 + kRootSlack) + broadcast(kLeast));
}
inline int certainly_together(const Together& least) {
  return mask_greater(least.end * broadcast(1 - kRootSlack),
                      least.begin * broadcast(1 + kRootSlack) + broadcast(kLeast));
}

// The lanes whose boxes are certainly apart throughout, of those that are not so on one axis at both ends; and those for
// which float leaves it open, among them all that may be apart on one axis at both ends: `least` then ends where it begins.
struct Closer {
  int apart, unsure;
};
template <class Directions>
inline Closer look_closer(const Directions& directions) {
  Together most, least;
  for (int k = 0; k < 6; ++k) {
    const Direction d = directions(k);
    const F8 s0 = d.a0 + d.b0, s1 = d.a1 + d.b1, e = error_of(d), slope = broadcast(1.0f) / (s0 - s1);
    most.limit(s0 + e, s1 + e, slope);
    least.limit(s0 - e, s1 - e, slope);
  }
  return {certainly_apart(most), ~certainly_together(least)};
}

}  // namespace
}  // namespace ONSET_KERNEL
}  // namespace onset
