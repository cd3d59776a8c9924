#include "narrowphase/kernel/float_positions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "base/parallel.hpp"

namespace onset {
namespace {

constexpr double kLargest = 0x1p60;  // squares of what is stored, and of differences, stay finite

// y errs by 2u of itself in double and by 2^-24 of itself, or 2^-150, in float (docs/theory.md, L25).
void round_row(const double* x, const std::array<double, 3>& middle, double scale, float* row) {
  double largest = 0;
  for (int end = 0; end < 2; ++end) {
    double square = 0;
    for (int a = 0; a < 3; ++a) {
      const double y = (x[4 * end + a] - middle[std::size_t(a)]) * scale;
      if (!(std::fabs(y) <= kLargest)) square = INFINITY;
      row[4 * end + a] = std::fabs(y) <= kLargest ? static_cast<float>(y) : 0.0f;
      square += y * y;
    }
    largest = std::max(largest, std::sqrt(square));
  }
  row[3] = static_cast<float>(largest * (0x1p-24 * (1 + 0x1p-20)) + 0x1p-140);
  row[7] = 0;
}

}  // namespace

// The median of a sample: a vertex that has flown off costs the others nothing.
std::array<double, 3> middle_of(std::vector<std::array<double, 3>> starts) {
  std::array<double, 3> middle{};
  for (std::size_t a = 0; a < 3 && !starts.empty(); ++a) {
    const auto half = starts.begin() + std::ptrdiff_t(starts.size() / 2);
    std::nth_element(starts.begin(), half, starts.end(),
                     [a](const auto& x, const auto& y) { return x[a] < y[a]; });
    middle[a] = (*half)[a];
  }
  return middle;
}

namespace {

std::array<double, 3> middle_of_motion(const Motion& motion) {
  std::vector<std::array<double, 3>> starts;
  const int stride = stride_of_middle(motion.num_vertices);
  for (int v = 0; v < motion.num_vertices; v += stride)
    starts.push_back({motion.t0(v)[0], motion.t0(v)[1], motion.t0(v)[2]});
  return middle_of(std::move(starts));
}

}  // namespace

AlignedArray<float> round_positions(const Motion& motion, double scale, const std::array<double, 3>* given) {
  AlignedArray<float> rows(std::size_t(motion.num_vertices) * kFloatStride);
  const std::array<double, 3> middle = given != nullptr ? *given : middle_of_motion(motion);
  parallel_ranges(std::size_t(motion.num_vertices), 4096, [&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v)
      round_row(motion.t0(int(v)), middle, scale, rows.data() + v * kFloatStride);
  });
  return rows;
}

}  // namespace onset
