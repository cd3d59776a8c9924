// Kernel text that makes the supports of vertices, the boxes of leaves, and those of the levels above.
#pragma once

#include "base/simd/pack.hpp"
#include "broadphase/bvh/kernel.hpp"

namespace onset {
namespace ONSET_ISA {
namespace {

// Writes the union of each lane's records as rows of a block; a record has a gap after each three supports.
template <bool kBothEnds>
void fit_leaf(const FitArguments& a, std::size_t n) {
  constexpr std::size_t kStride = kBoxStrideOf[kBothEnds];
  const int* members = a.members + n * unsigned(a.members_each * kBlock);
  float* out = a.tree.level[0] + n * unsigned(kRowsOf[kBothEnds] * kLanes);
  for (int end = 0; end < (kBothEnds ? 2 : 1); ++end) {
    const float* supports = a.supports + end * kLanes;
    F8 row[8];
    for (int lane = 0; lane < kLanes; ++lane) {
      row[lane] = F8::load(supports + std::size_t(members[lane]) * kStride);
      for (int k = 1; k < a.members_each; ++k)
        row[lane] = max(F8::load(supports + std::size_t(members[k * kBlock + lane]) * kStride), row[lane]);
    }
    transpose(row);
    for (int k = 0; k < 6; ++k) row[k < 3 ? k : k + 1].store(out + (end * 6 + k) * kLanes);
  }
}

// What FloatMap and motion_box do to vertices without thickness, one axis a lane.
class VertexSupports {
 public:
  explicit VertexSupports(const SupportArguments& a)
      : centre_(D4::load(a.centre)), scale_(D4::all(a.scale)), inverse_(D4::all(a.inverse)), t_max_(a.t_max) {
    const double r[4] = {a.inflation, a.inflation, a.inflation, 0};
    widened_by_ = D4::load(r);
  }

  template <bool kWidened, bool kStopped>
  void write(const double* x, float* out) {
    const D4 start = D4::load(x);
    D4 lo = D4::load(x + 4), hi = lo;
    if (kStopped) {  // at_t_max in broadphase/interval.hpp
      const D4 end = lo, there = D4::all(1 - t_max_) * start + D4::all(t_max_) * end;
      const D4 error = max(abs(start), abs(end)) * D4::all(0x1p-50) + D4::all(0x1p-1070);
      lo = max(min(end, start), there - error), hi = min(max(end, start), there + error);
    }
    write_end<kWidened>(start, start, out);
    write_end<kWidened>(lo, hi, out + kLanes);
  }
  // Bit i: the map is not one to one on axis i.
  int rounded_axes() const { return ~exact_ & 7; }

 private:
  template <bool kWidened>
  void write_end(D4 lo, D4 hi, float* out) {
    if (kWidened) {  // widen_down and widen_up; padding stays 0
      const D4 below = lo - widened_by_, above = hi + widened_by_;
      lo = below - abs(below) * D4::all(0x1p-52), hi = above + abs(above) * D4::all(0x1p-52);
    }
    const float minus[8] = {-1, -1, -1, -1, 1, 1, 1, 1};
    const F8 y = map(lo, hi);
    where_negative(F8::load(minus), F8::all(0) - y, y).store(out);
  }
  // Never -0.
  F8 map(D4 a, D4 b) {
    const D4 most = D4::all(double(0x1p120f)), least = D4::all(-double(0x1p120f));
    const D4 p = (a - centre_) * scale_, q = (b - centre_) * scale_;
    const F8 y = to_float(min(max(p, least), most), min(max(q, least), most)) + F8::all(0);
    D4 back_a, back_b;
    to_double(y, back_a, back_b);
    exact_ &= bits((back_a * inverse_ + centre_ == a) & (back_b * inverse_ + centre_ == b));
    return y;
  }

  D4 centre_, scale_, inverse_, widened_by_;
  double t_max_;
  int exact_ = 0xf;
};

template <bool kWidened, bool kStopped>
int write_each(const SupportArguments& a, std::size_t first, std::size_t last) {
  constexpr std::size_t kAhead = 16;  // prefetched: the processor cannot foresee the order
  const std::size_t stride = std::size_t(kBoxStrideOf[!a.swept]);
  VertexSupports supports(a);
  for (std::size_t i = first; i < last; ++i) {
    if (i + kAhead < last) __builtin_prefetch(a.motion + std::size_t(a.ids[i + kAhead]) * 8);
    const double* x = a.motion + std::size_t(a.ids[i]) * 8;
    float record[16], *out = a.records + (a.by_id ? std::size_t(a.ids[i]) : i) * stride;
    supports.write<kWidened, kStopped>(x, a.swept ? record : out);
    if (a.swept) max(F8::load(record), F8::load(record + kLanes)).store(out);
  }
  return supports.rounded_axes();
}

}  // namespace

int write_vertices(const SupportArguments& a, std::size_t first, std::size_t last) {
  const bool widened = a.inflation > 0, stopped = a.t_max != 1;
  if (stopped)
    return widened ? write_each<true, true>(a, first, last) : write_each<false, true>(a, first, last);
  return widened ? write_each<true, false>(a, first, last) : write_each<false, false>(a, first, last);
}

void fit_leaves(const FitArguments& a, std::size_t first, std::size_t last) {
  for (std::size_t n = first; n < last; ++n) a.motion ? fit_leaf<true>(a, n) : fit_leaf<false>(a, n);
}

// A lane of a level is the union of a block below: the maximum of each of its rows.
void fit_level(const TreeView& tree, int level, bool motion, std::size_t first, std::size_t last) {
  const int rows = kRowsOf[motion], stride = kBoxStrideOf[motion];
  const std::size_t size = std::size_t(rows * kLanes), below = std::size_t(tree.blocks[level - 1]);
  const float nowhere = kNowhere;
  for (std::size_t n = first; n < last; ++n) {
    F8 lanes[16];
    for (int k = 0; k < 16; ++k) lanes[k] = F8::all(nowhere);
    for (int k = 0; k < rows; ++k) {
      F8 row[8];
      for (std::size_t i = 0; i < kBlock; ++i) {
        const std::size_t child = n * kBlock + i;
        row[i] =
            child < below ? F8::load(tree.level[level - 1] + child * size + k * kLanes) : F8::all(nowhere);
      }
      transpose(row);
      for (int i = 1; i < kLanes; ++i) row[0] = max(row[0], row[i]);
      row[0].store(tree.level[level] + n * size + k * kLanes);
      lanes[k] = row[0];
    }
    for (int half = 0; half < stride / 8; ++half) {
      transpose(lanes + 8 * half);
      for (std::size_t i = 0; i < kBlock && n * kBlock + i < below; ++i)
        lanes[8 * half + int(i)].store(tree.box[level - 1] + (n * kBlock + i) * unsigned(stride) + 8 * half);
    }
  }
}

}  // namespace ONSET_ISA
}  // namespace onset
