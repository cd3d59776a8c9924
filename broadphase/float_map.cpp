#include "broadphase/float_map.hpp"

#include <cmath>

namespace onset {

namespace {

constexpr int kSamples = 256;       // vertices; both ends of each
constexpr std::size_t kStride = 2;  // samples a knot

// Ascending.
std::array<std::vector<double>, 3> sample(const Motion& motion) {
  std::array<std::vector<double>, 3> samples;
  const int step = std::max(1, motion.num_vertices / kSamples);
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
  // To a coarse multiple: coordinates that came from single precision then mostly stay exact, which spares
  // the close calls.
  const double grid = std::ldexp(1.0, std::min(exponent + 3, 1020));
  for (double& c : centre_)
    if (std::fabs(c) < grid * 0x1p50) c = std::nearbyint(c / grid) * grid;
}

// Whether neighbours among the samples are mostly told apart.
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

// Monotone: within an interval every operation is, and 1 is where the next interval begins.
float FloatMap::between_knots(double x, std::size_t axis) const {
  const std::vector<double>& knots = knots_[axis];
  const auto above = std::upper_bound(knots.begin() + 1, knots.end() - 1, x);
  const double lower = above[-1], width = *above - lower, place = double(above - 1 - knots.begin());
  double t = (x - lower) / width;  // below 0 and beyond 1 outside of the knots
  if (above != knots.end() - 1) t = std::min(t, 1.0);
  return to_float((place + t - 0.5 * double(knots.size())) * 0x1p-6);
}

}  // namespace onset
