#include "broadphase/supports.hpp"

#include <atomic>

#include "base/parallel.hpp"

namespace onset {

namespace {

constexpr std::size_t kGrain = 2048;
constexpr int kSamples = 512;

// Writes one end of a record, returns the axes on which the map rounded.
int write_end(const FloatMap& map, const std::array<double, 3>& lo, const std::array<double, 3>& hi,
              float* out) {
  int rounded = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const float below = map(lo[i], i), above = map(hi[i], i);
    out[i] = -below, out[3 + i] = above;
    rounded |= int(!(map.inverts(below, lo[i], i) && map.inverts(above, hi[i], i))) << i;
  }
  out[6] = out[7] = 0;
  return rounded;
}

int write_record(const FloatMap& map, BoxTest test, const MotionBox& box, float* out) {
  const int rounded =
      write_end(map, box.lo_t0, box.hi_t0, out) | write_end(map, box.lo_t1, box.hi_t1, out + kBlock);
  if (test == BoxTest::swept)
    for (int k = 0; k < 6; ++k) out[k] = std::max(out[k], out[kBlock + k]);
  return rounded;
}

Supports make_supports(const BroadPhaseInput& input, const FloatMap& map, Primitive kind) {
  Supports s;
  s.count = primitive_count(input.mesh, kind);
  s.records = AlignedArray<float>((s.count + 1) * kSupportStride);
  std::fill_n(s.records.data() + s.count * kSupportStride, kSupportStride, kNowhere);
  std::atomic<int> rounded{0};
  parallel_ranges(s.count, kGrain, [&](std::size_t first, std::size_t last) {
    int mine = 0;
    for (std::size_t i = first; i < last; ++i)
      mine |= write_record(map, input.test, motion_box(input, kind, int(i)),
                           s.records.data() + i * kSupportStride);
    rounded.fetch_or(mine);
  });
  s.rounded_axes = rounded;
  return s;
}

double median(std::vector<double>& values) {
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

FloatMap make_float_map(const Motion& motion) {
  FloatMap map;
  if (motion.num_vertices == 0) return map;
  const int step = std::max(1, motion.num_vertices / kSamples);
  double spread = 0, furthest = 0;
  std::vector<double> sample;
  for (std::size_t i = 0; i < 3; ++i) {
    sample.clear();
    for (int v = 0; v < motion.num_vertices; v += step)
      sample.push_back(motion.t0(v)[i]), sample.push_back(motion.t1(v)[i]);
    map.centre[i] = median(sample);
    for (double& x : sample) x = std::fabs(x - map.centre[i]), furthest = std::max(furthest, x);
    spread = std::max(spread, median(sample));
  }
  const double size = spread > 0 ? spread : furthest;
  if (size > 0) map.scale = std::ldexp(1.0, std::min(-std::ilogb(size), 1000));
  return map;
}

Supports vertex_supports(const BroadPhaseInput& input, const FloatMap& map) {
  return make_supports(input, map, Primitive::vertex);
}
Supports primitive_supports(const BroadPhaseInput& input, const FloatMap& map, Primitive kind) {
  return make_supports(input, map, kind);
}

}  // namespace onset
