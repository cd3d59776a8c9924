#include "scene/motion/storing.hpp"

#include <algorithm>
#include <array>

#include "base/parallel.hpp"
#include "base/simd/rows.hpp"

namespace onset {
namespace {

// Of the vertices [first, last).
double largest_magnitude(const Motion& m, std::size_t first, std::size_t last) {
  D4 largest = D4::all(0);
  for (const double* x = m.x.data() + first * kMotionStride; first < last; ++first, x += kMotionStride)
    largest = max(abs(D4::load(x)), max(abs(D4::load(x + 4)), largest));
  std::array<double, 4> of_axis;
  largest.store(of_axis.data());
  return *std::max_element(of_axis.begin(), of_axis.end());
}

}  // namespace

double rounding_of_distances(const Motion& m) {
  constexpr std::size_t kGrain = 4096;
  const double largest = parallel_reduce(
      std::size_t(m.num_vertices), kGrain, m.largest_elsewhere,
      [&](std::size_t first, std::size_t last) { return largest_magnitude(m, first, last); },
      [](double x, double y) { return std::max(x, y); });
  return (kStoring * largest + 0x1p-1070) * (1 + 0x1p-50);
}

}  // namespace onset
