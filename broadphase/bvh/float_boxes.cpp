#include "broadphase/bvh/float_boxes.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/parallel.hpp"
#include "broadphase/bvh/box_tree.hpp"

namespace onset {

namespace {

constexpr int kSamples = 256;       // vertices at most; both ends of each
constexpr int kFewSamples = 32;     // of a small mesh, where an eighth of the vertices is fewer
constexpr std::size_t kStride = 2;  // samples a knot

// Samples the coordinates of each axis, in ascending order.
std::array<std::vector<double>, 3> sample(const Motion& motion) {
  std::array<std::vector<double>, 3> samples;
  const int wanted = std::clamp(motion.num_vertices / 8, kFewSamples, kSamples);
  const int step = std::max(1, motion.num_vertices / wanted);
  for (std::size_t i = 0; i < 3; ++i) {
    for (int v = 0; v < motion.num_vertices; v += step)
      samples[i].push_back(motion.t0(v)[i]), samples[i].push_back(motion.t1(v)[i]);
    std::sort(samples[i].begin(), samples[i].end());
  }
  return samples;
}

double median_distance(std::vector<double> samples, double from) {
  for (double& x : samples) x = std::fabs(x - from);
  const auto middle = samples.begin() + std::ptrdiff_t(samples.size() / 2);
  std::nth_element(samples.begin(), middle, samples.end());
  return *middle;
}

}  // namespace

FloatMap::FloatMap(const Motion& motion) {
  const auto samples = sample(motion);
  if (motion.status != Outcome::free || samples[0].empty()) return;
  fit_linear(samples);
  if (separates(samples)) return;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < samples[i].size(); k += kStride)
      if (knots_[i].empty() || samples[i][k] > knots_[i].back()) knots_[i].push_back(samples[i][k]);
    if (knots_[i].size() < 2) knots_[i].clear();
  }
}

bool FloatMap::suits(const Motion& motion) const {
  const auto samples = sample(motion);
  return samples[0].empty() || separates(samples);
}

void FloatMap::fit_linear(const std::array<std::vector<double>, 3>& samples) {
  double spread = 0, furthest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::vector<double>& x = samples[i];
    centre_[i] = x[x.size() / 2];
    spread = std::max(spread, median_distance(x, centre_[i]));
    furthest = std::max(furthest, std::max(x.back() - centre_[i], centre_[i] - x.front()));
  }
  const double size = spread > 0 ? spread : furthest;
  if (size == 0) return;
  const int exponent = std::ilogb(size);
  scale_ = std::ldexp(1.0, std::min(-exponent, 1000)), inverse_ = 1 / scale_;
  // A coarse multiple as centre mostly keeps coordinates that came from single precision exact, which spares
  // decisions in double.
  const double grid = std::ldexp(1.0, std::min(exponent + 3, 1020));
  for (double& c : centre_)
    if (std::fabs(c) < grid * 0x1p50) c = std::nearbyint(c / grid) * grid;
}

// Says whether neighbouring samples mostly differ as floats.
bool FloatMap::separates(const std::array<std::vector<double>, 3>& samples) const {
  for (std::size_t i = 0; i < 3; ++i) {
    std::size_t distinct = 0, merged = 0;
    for (std::size_t k = 1; k < samples[i].size(); ++k) {
      if (samples[i][k] == samples[i][k - 1]) continue;
      ++distinct;
      merged += (*this)(samples[i][k], i) == (*this)(samples[i][k - 1], i);
    }
    if (8 * merged > distinct) return false;
  }
  return true;
}

// It is monotone: within an interval every operation is, and t ends at 1, where the next interval begins.
float FloatMap::between_knots(double x, std::size_t axis) const {
  const std::vector<double>& knots = knots_[axis];
  const auto above = std::upper_bound(knots.begin() + 1, knots.end() - 1, x);
  const double lower = above[-1], width = *above - lower, place = double(above - 1 - knots.begin());
  double t = (x - lower) / width;  // below 0 or beyond 1 outside of the knots
  if (above != knots.end() - 1) t = std::min(t, 1.0);
  return to_float((place + t - 0.5 * double(knots.size())) * 0x1p-6);
}

namespace {

constexpr std::size_t kGrain = 2048;

// Writes one end of a record and returns the axes on which the map rounded.
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

int write_any(const BroadPhaseInput& input, double inflation, const FloatMap& map, Primitive kind,
              const int* ids, std::size_t first, std::size_t last, const RecordsAt& at) {
  const bool swept = input.test == BoxTest::swept;
  float record[2 * kBlock];
  int rounded = 0;
  for (std::size_t i = first; i < last; ++i) {
    rounded |= write_record(map, motion_box(input, kind, ids[i], inflation), record);
    float* out = at(i, ids[i]);
    for (int k = 0; k < kBlock; ++k) out[k] = swept ? std::max(record[k], record[kBlock + k]) : record[k];
    if (!swept) std::copy(record + kBlock, record + 2 * kBlock, out + kBlock);
  }
  return rounded;
}

}  // namespace

int write_supports(const BroadPhaseInput& input, double inflation, const FloatMap& map, Primitive kind,
                   const int* ids, std::size_t count, const RecordsAt& at, const Stop& stop) {
  const bool rows = kind == Primitive::vertex && input.mesh.thickness.empty() && map.is_linear();
  SupportArguments vertices{};
  if (rows) {
    map.describe(vertices);
    vertices.motion = input.motion.x.data(), vertices.ids = ids;
    vertices.inflation = inflation, vertices.t_max = input.t_max;
    vertices.swept = input.test == BoxTest::swept, vertices.by_id = at.by_id, vertices.records = at.records;
  }
  const BvhKernel& kernel = bvh_kernel(input.instruction_set);
  std::atomic<int> rounded{0};
  parallel_ranges(count, kGrain, [&](std::size_t first, std::size_t last) {
    int mine = 0;
    for (; first < last && !stop.requested(); first += kGrain) {
      const std::size_t end = std::min(first + kGrain, last);
      mine |= rows ? kernel.write_vertices(vertices, first, end)
                   : write_any(input, inflation, map, kind, ids, first, end, at);
    }
    rounded.fetch_or(mine);
  });
  return rounded;
}

Supports make_supports(const BroadPhaseInput& input, double inflation, const FloatMap& map, Primitive kind,
                       const int* ids, std::size_t count, const Stop& stop) {
  const std::size_t stride = std::size_t(kBoxStrideOf[input.test != BoxTest::swept]);
  Supports s;
  s.count = count;
  s.records = AlignedArray<float>((s.count + 1) * stride);
  std::fill_n(s.records.data() + s.count * stride, stride, kNowhere);
  s.rounded_axes =
      write_supports(input, inflation, map, kind, ids, count, {s.records.data(), stride, false}, stop);
  return s;
}

}  // namespace onset
