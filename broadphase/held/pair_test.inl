// Kernel text that tests pairs one by one, each with the boxes that its vertices span.
#pragma once

#include <new>

#include "base/assert.hpp"
#include "broadphase/bvh/box_overlap.inl"
#include "broadphase/diagonals/test.inl"
#include "broadphase/held/kernel.hpp"

namespace onset {
namespace ONSET_ISA {
namespace {

// A box at the start and at the end: -x -y -z 0 +x +y +z 0.
struct Ends {
  F8 start, end;
};

template <int kEach>
__attribute__((always_inline)) inline Ends spanned(const float* records, const int* vertices) {
  const float* r = records + std::size_t(unsigned(vertices[0])) * 16;
  Ends box{F8::load(r), F8::load(r + kLanes)};
  for (int k = 1; k < kEach; ++k) {
    r = records + std::size_t(unsigned(vertices[k])) * 16;
    box.start = max(F8::load(r), box.start), box.end = max(F8::load(r + kLanes), box.end);
  }
  return box;
}

// What box_overlap.inl does to one box and eight, done to eight directions of two boxes: a lane is the reach
// of the first along a direction and of the second along the opposite one.
template <int kFirst, int kSecond, bool kMoving, bool kDiagonals>
class PairTest {
 public:
  static void run(const HeldArguments& arguments) {
    static_assert(sizeof(PairTest) <= sizeof(TraversalMemory), "");
    (new (arguments.memory) PairTest(arguments))->run();
  }

 private:
  explicit PairTest(const HeldArguments& arguments) : t_(arguments) {}
  static void* operator new(std::size_t, TraversalMemory* memory) { return memory; }

  void run() {
    constexpr std::size_t kBetweenLooks = 4096;
    for (std::size_t first = 0; first < t_.count; first += kBetweenLooks) {
      if (t_.stop != nullptr && t_.stop(t_.stop_context)) return;
      run(first, t_.count - first < kBetweenLooks ? t_.count : first + kBetweenLooks);
    }
    settle_doubtful();
    flush();
  }

  static const int* of(const int* vertices, const int& id, int each) {
    return each == 1 ? &id : vertices + std::size_t(unsigned(id)) * unsigned(each);
  }

  void run(std::size_t first, std::size_t last) {
    const HeldArguments t = t_;  // a copy, which no write can change
    const DiagonalTester test(kDiagonals ? *t.diagonals : DiagonalLimits{});
    const int rounded = kMoving ? 0 : (t.rounded_axes | t.rounded_axes << 4);
    for (std::size_t i = first; i < last; ++i) {
      const IdPair p = t.pairs[i];
      const Ends a = spanned<kFirst>(t.first_records, of(t.first_vertices, t.pairs[i].a, kFirst));
      const Ends b = spanned<kSecond>(t.second_records, of(t.second_vertices, t.pairs[i].b, kSecond));
      const F8 at_start = a.start + swap_halves(b.start), at_end = a.end + swap_halves(b.end);
      const F8 at_both = max(at_end, at_start);
      // As in DiagonalVerdict: what drops a pair, shifted up, and what leaves it in doubt.
      unsigned bits = unsigned(sign_bits(at_both)) << 8, left_open = 0;
      F8 along = at_both;
      if (kDiagonals) along = reach_along_diagonals_of(t, i), left_open = test(along).bits, bits |= left_open;
      const bool boxes = in_doubt(at_start, at_end, at_both, rounded);
      bits |= unsigned(boxes);
      if (bits - 1 < 0xff) {
        defer(p, a, b, boxes, left_open == 0 ? 0 : open(i, along));
        continue;
      }
      out_[count_] = in_order(p);
      count_ += bits == 0;
      if (count_ == kBatchSize) flush();
    }
  }

  __attribute__((always_inline)) static F8 reach_along_diagonals_of(const HeldArguments& t, std::size_t i) {
    const IdPair& p = t.pairs[i];
    return reach_along_diagonals(
        spanned_along_diagonals<kFirst>(t.first_diagonals, of(t.first_vertices, p.a, kFirst), 1),
        spanned_along_diagonals<kSecond>(t.second_diagonals, of(t.second_vertices, p.b, kSecond), 1));
  }
  // As LeafDiagonals::open.
  __attribute__((noinline)) unsigned open(std::size_t i, F8 reach) const {
    const IdPair& p = t_.pairs[i];
    const bool far_out = t_.diagonals->far_out &&
                         (is_far_out<kFirst>(t_.first_diagonals, of(t_.first_vertices, p.a, kFirst), 1) ||
                          is_far_out<kSecond>(t_.second_diagonals, of(t_.second_vertices, p.b, kSecond), 1));
    return open_diagonals(*t_.diagonals, reach, far_out);
  }

  static IdPair in_order(const IdPair& p) { return kFirst == 2 && p.b < p.a ? IdPair{p.b, p.a} : p; }

  static constexpr int kAxes = 0x77;  // the lanes that are not padding
  // As Traversal::in_doubt.
  static bool in_doubt(F8 at_start, F8 at_end, F8 at_both, int rounded) {
    const F8 zero = F8::all(0);
    if (kMoving)
      return (unsigned((bits(at_start <= zero) & kAxes) != 0) &
              unsigned((bits(at_end <= zero) & kAxes) != 0)) != 0;
    return rounded != 0 && (bits(at_both == zero) & rounded) != 0;
  }

  __attribute__((noinline)) void defer(const IdPair& p, const Ends& a, const Ends& b, bool boxes,
                                       unsigned open) {
    doubtful_[waiting_] = p, boxes_[waiting_] = boxes, open_[waiting_] = open;
    float* at = supports_[waiting_];
    a.start.store(at), a.end.store(at + kLanes), b.start.store(at + 2 * kLanes), b.end.store(at + 3 * kLanes);
    if (++waiting_ == kLanes) settle_doubtful();
  }

  void settle_doubtful() {
    MovingBoxes p{0, 0xff};
    if (kMoving && t_.linear && waiting_ > 0) p = compare();
    for (int open = ((1 << waiting_) - 1) & ~p.apart; open != 0; open &= open - 1) {
      const int lane = lowest_lane(open);
      const IdPair pair = in_order(doubtful_[lane]);
      const bool unsure = boxes_[lane] && (p.unsure >> lane & 1) != 0;
      if (open_[lane] != 0 && t_.diagonals_apart(t_.context, pair.a, pair.b, open_[lane])) continue;
      if (unsure && !t_.meets(t_.context, pair.a, pair.b)) continue;
      out_[count_++] = pair;
      if (count_ == kBatchSize) flush();
    }
    waiting_ = 0;
  }

  MovingBoxes compare() const {
    const float* at[kLanes];
    for (int l = 0; l < kLanes; ++l) at[l] = supports_[l < waiting_ ? l : 0];
    return moving_boxes_apart([&](int k) {
      const int lane = k < 3 ? k : k + 1, across = opposite(k) < 3 ? opposite(k) : opposite(k) + 1;
      return Direction{collect(at, across), collect(at, kLanes + across), collect(at, 2 * kLanes + lane),
                       collect(at, 3 * kLanes + lane)};
    });
  }

  void flush() {
    if (count_ > 0) t_.consume(t_.consume_context, out_, count_);
    count_ = 0;
  }

  const HeldArguments& t_;
  int waiting_ = 0;
  std::size_t count_ = 0;
  IdPair doubtful_[kLanes];
  bool boxes_[kLanes];     // whether it is boxes that leave them in doubt
  unsigned open_[kLanes];  // the diagonals that do
  float supports_[kLanes][4 * kLanes];
  IdPair out_[kBatchSize];
};

template <int kFirst, int kSecond, bool kMoving>
void test_any(const HeldArguments& a) {
  a.diagonals != nullptr ? PairTest<kFirst, kSecond, kMoving, true>::run(a)
                         : PairTest<kFirst, kSecond, kMoving, false>::run(a);
}

template <bool kMoving>
void test_sides(const HeldArguments& a) {
  if (a.sides == Sides::vertices_faces)
    test_any<1, 3, kMoving>(a);
  else if (a.sides == Sides::vertices_edges)
    test_any<1, 2, kMoving>(a);
  else
    test_any<2, 2, kMoving>(a);
}

}  // namespace

void test_pairs(const HeldArguments& arguments) {
  ONSET_ASSERT(arguments.test != BoxTest::swept);
  arguments.test == BoxTest::moving ? test_sides<true>(arguments) : test_sides<false>(arguments);
}

}  // namespace ONSET_ISA
}  // namespace onset
