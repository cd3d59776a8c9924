// Kernel text: two primitives along the diagonals, which are the lanes.
#pragma once

#include "base/simd/pack.hpp"
#include "broadphase/diagonals/kernel.hpp"

namespace onset {
namespace ONSET_ISA {
namespace {

// How far a primitive extends along the diagonals at both ends.
struct DiagonalSpan {
  F8 least_t0, most_t0, least_t1, most_t1;
};

// Spans the records of kEach vertices, whose numbers are `stride` ints apart.
template <int kEach>
__attribute__((always_inline)) inline DiagonalSpan spanned_along_diagonals(const float* records,
                                                                           const int* vertices, int stride) {
  const float* r = records + std::size_t(unsigned(vertices[0])) * unsigned(kDiagonalStride);
  const F8 t0 = F8::load(r), t1 = F8::load(r + 8);
  DiagonalSpan span{t0, t0, t1, t1};
  for (int k = 1; k < kEach; ++k) {
    r = records + std::size_t(unsigned(vertices[k * stride])) * unsigned(kDiagonalStride);
    const F8 start = F8::load(r), end = F8::load(r + 8);
    span.least_t0 = min(start, span.least_t0), span.most_t0 = max(start, span.most_t0);
    span.least_t1 = min(end, span.least_t1), span.most_t1 = max(end, span.most_t1);
  }
  return span;
}
// Says whether one of these vertices is too far out.
template <int kEach>
inline bool is_far_out(const float* records, const int* vertices, int stride) {
  for (int k = 0; k < kEach; ++k)
    if (records[std::size_t(unsigned(vertices[k * stride])) * unsigned(kDiagonalStride)] == kFarOut)
      return true;
  return false;
}

// Returns how far they reach over one another, on the side and at the end of each where that is less on the
// one and more at the other: below 0 where a diagonal separates them on one side at both ends.
__attribute__((always_inline)) inline F8 reach_along_diagonals(const DiagonalSpan& a, const DiagonalSpan& b) {
  const F8 above = max(a.most_t0 - b.least_t0, a.most_t1 - b.least_t1);
  const F8 below = max(b.most_t0 - a.least_t0, b.most_t1 - a.least_t1);
  return min(above, below);
}

// Whether a diagonal separates a pair, or leaves it to doubles. Both come from one number, so that compilers
// do not branch on the first alone, which no processor can foresee.
struct DiagonalVerdict {
  unsigned bits;  // of the diagonals that do, shifted up, and of those that do or may

  bool apart() const { return bits > 0xff; }
  bool in_doubt() const { return bits - 1 < 0xff; }
};
class DiagonalTester {
 public:
  // Where vertices may be far out, a reach of 0 and less or about kFarOut is in doubt, too (docs/theory.md,
  // L53).
  explicit DiagonalTester(const DiagonalLimits& limits)
      : apart_(F8::load(limits.apart)),
        together_(limits.far_out ? min(F8::load(limits.together), F8::all(-0x1p-120f))
                                 : F8::load(limits.together)),
        far_out_(F8::all(limits.far_out ? 0.25f * kFarOut : 0x1p126f)) {}
  __attribute__((always_inline)) DiagonalVerdict operator()(F8 reach) const {
    const F8 together = min(reach + together_, far_out_ - reach);
    return {unsigned(sign_bits(reach + apart_)) << 8 | unsigned(sign_bits(together))};
  }

 private:
  F8 apart_, together_, far_out_;
};

// Returns the diagonals that doubles have to decide about, of a pair that the tester leaves in doubt.
inline unsigned open_diagonals(const DiagonalLimits& limits, F8 reach, bool far_out) {
  return far_out ? 0xff : unsigned(sign_bits(reach + F8::load(limits.together)));
}

// The leaves of two trees, by their slots, of primitives of so many vertices.
template <int kOwn, int kOther>
class LeafDiagonals {
 public:
  LeafDiagonals(const DiagonalPlaces& query, const DiagonalPlaces& tree, const DiagonalLimits& limits)
      : test(limits), query_(query), tree_(tree), limits_(limits) {}

  const DiagonalTester test;
  __attribute__((always_inline)) DiagonalSpan own(unsigned slot) const {
    return spanned_along_diagonals<kOwn>(query_.records, vertices<kOwn>(query_, slot / kLanes, slot % kLanes),
                                         kLanes);
  }
  __attribute__((always_inline)) F8 reach(const DiagonalSpan& own, unsigned block, unsigned lane) const {
    return reach_along_diagonals(
        own, spanned_along_diagonals<kOther>(tree_.records, vertices<kOther>(tree_, block, lane), kLanes));
  }
  // Returns the diagonals that doubles have to decide about, of a pair that the tester leaves in doubt.
  __attribute__((noinline)) unsigned open(unsigned c, unsigned block, unsigned lane, F8 reach) const {
    const bool far_out =
        limits_.far_out &&
        (is_far_out<kOwn>(query_.records, vertices<kOwn>(query_, c / kLanes, c % kLanes), kLanes) ||
         is_far_out<kOther>(tree_.records, vertices<kOther>(tree_, block, lane), kLanes));
    return open_diagonals(limits_, reach, far_out);
  }

 private:
  template <int kEach>
  __attribute__((always_inline)) static const int* vertices(const DiagonalPlaces& p, unsigned block,
                                                            unsigned lane) {
    return p.vertices + (std::size_t(block) * unsigned(kEach * kLanes) + lane);
  }
  const DiagonalPlaces query_, tree_;  // copies, which no write can change
  const DiagonalLimits& limits_;
};

}  // namespace
}  // namespace ONSET_ISA
}  // namespace onset
