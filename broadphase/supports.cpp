#include "broadphase/supports.hpp"

#include <algorithm>
#include <atomic>

#include "base/parallel.hpp"
#include "broadphase/interval.hpp"

namespace onset {

namespace {

constexpr std::size_t kGrain = 2048;
constexpr std::size_t kAhead = 16;  // vertices are read in an order that the processor cannot foresee

// Writes one end of a record, returns the axes on which the map rounded.
int write_end(const FloatMap& map, const std::array<double, 3>& lo, const std::array<double, 3>& hi,
              float* out) {
  int rounded = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const float below = map(lo[i], i), above = map(hi[i], i);
    out[i] = 0 - below, out[4 + i] = above;
    rounded |= int(!(map.inverts(below, lo[i], i) && map.inverts(above, hi[i], i))) << i;
  }
  out[3] = out[7] = 0;
  return rounded;
}

int write_record(const FloatMap& map, const MotionBox& box, float* out) {
  return write_end(map, box.lo_t0, box.hi_t0, out) | write_end(map, box.lo_t1, box.hi_t1, out + kBlock);
}

// A vertex that is not widened, both ends at once: x y z 0 x y z 0.
int write_point(const FloatMap& map, const double* x, float* out) {
  float y[8];
  int rounded[8];
  for (std::size_t k = 0; k < 8; ++k) {
    y[k] = map(x[k], k % 4);
    rounded[k] = int(!map.inverts(y[k], x[k], k % 4));
  }
  for (std::size_t k = 0; k < 4; ++k) {
    out[k] = 0 - y[k], out[4 + k] = y[k];
    out[8 + k] = 0 - y[4 + k], out[12 + k] = y[4 + k];
  }
  return (rounded[0] | rounded[4]) | (rounded[1] | rounded[5]) << 1 | (rounded[2] | rounded[6]) << 2;
}

// The same widened by r > 0, as motion_box widens it: the map is then not one to one.
int write_widened_point(const FloatMap& map, const double* x, double r, float* out) {
  float below[8], above[8];
  for (std::size_t k = 0; k < 8; ++k) below[k] = map(widen_down(x[k], r), k % 4);
  for (std::size_t k = 0; k < 8; ++k) above[k] = map(widen_up(x[k], r), k % 4);
  for (std::size_t k = 0; k < 4; ++k) {
    const bool padding = k == 3;
    out[k] = padding ? 0 : 0 - below[k], out[4 + k] = padding ? 0 : above[k];
    out[8 + k] = padding ? 0 : 0 - below[4 + k], out[12 + k] = padding ? 0 : above[4 + k];
  }
  return 7;
}

}  // namespace

Supports make_supports(const BroadPhaseInput& input, double inflation, const FloatMap& map, Primitive kind,
                       const int* ids, std::size_t count) {
  const bool swept = input.test == BoxTest::swept;
  const bool points =
      kind == Primitive::vertex && input.mesh.thickness.empty() && input.horizon == 1;
  const std::size_t stride = std::size_t(kBoxStrideOf[!swept]);
  Supports s;
  s.count = count;
  s.records = AlignedArray<float>((s.count + 1) * stride);
  std::fill_n(s.records.data() + s.count * stride, stride, kNowhere);
  std::atomic<int> rounded{0};
  parallel_ranges(s.count, kGrain, [&](std::size_t first, std::size_t last) {
    int mine = 0;
    float record[2 * kBlock];
    for (std::size_t i = first; i < last; ++i) {
      if (points && i + kAhead < last) __builtin_prefetch(input.motion.t0(ids[i + kAhead]));
      if (points)
        mine |= inflation == 0 ? write_point(map, input.motion.t0(ids[i]), record)
                               : write_widened_point(map, input.motion.t0(ids[i]), inflation, record);
      else
        mine |= write_record(map, motion_box(input, kind, ids[i], inflation), record);
      float* out = s.records.data() + i * stride;
      for (int k = 0; k < kBlock; ++k) out[k] = swept ? std::max(record[k], record[kBlock + k]) : record[k];
      if (!swept) std::copy(record + kBlock, record + 2 * kBlock, out + kBlock);
    }
    rounded.fetch_or(mine);
  });
  s.rounded_axes = rounded;
  return s;
}

}  // namespace onset
