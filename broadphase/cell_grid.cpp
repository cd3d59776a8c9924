#include "broadphase/cell_grid.hpp"

#include <algorithm>
#include <cmath>

namespace onset {

CellGrid::CellGrid(const std::vector<const std::vector<FloatBox>*>& sets, std::size_t limit,
                   const Stop& stop) {
  double sum = 0;
  std::size_t count = 0;
  for (const auto* set : sets) {
    count += set->size();
    each_unless(stop, 0, set->size(), [&](std::size_t k) {
      const FloatBox& b = (*set)[k];
      double widest = 0;
      for (std::size_t i = 0; i < 3; ++i) widest = std::max(widest, double(b.hi[i]) - double(b.lo[i]));
      sum += widest;
    });
  }
  // FloatMap gives the bulk a spread of about 1, so cells of 2^-17 keep it off the outermost ones.
  const double width = count > 0 ? std::max(2 * sum / double(count), 0x1p-17) : 1;
  for (cells_per_unit_ = 1 / width; !fits(sets, limit) && !stop.requested();) cells_per_unit_ /= 2;
}

CellGrid::Corner CellGrid::corner(const std::array<float, 3>& point) const {
  constexpr double kMiddle = 1 << (kBits - 1);
  Corner c;
  for (std::size_t i = 0; i < 3; ++i) {
    const double x = std::floor(double(point[i]) * cells_per_unit_) + kMiddle;
    c[i] = std::uint32_t(std::min(std::max(x, 0.0), 2 * kMiddle - 1));
  }
  return c;
}

bool CellGrid::fits(const std::vector<const std::vector<FloatBox>*>& sets, std::size_t limit) {
  covered_ = 0;
  for (const auto* set : sets)
    for (const FloatBox& b : *set) {
      const Corner lo = corner(b.lo), hi = corner(b.hi);
      std::size_t cells = 1;
      for (std::size_t i = 0; i < 3; ++i) cells *= hi[i] - lo[i] + 1;  // at most 2^60
      if ((covered_ += cells) > limit) return false;
    }
  return true;
}

}  // namespace onset
