#include "broadphase/cell_grid.hpp"

#include <algorithm>
#include <cmath>

namespace onset {

namespace {

constexpr int kCellBits = 20;
constexpr double kMiddle = 1 << (kCellBits - 1);

std::uint64_t pack(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  return std::uint64_t(x) | std::uint64_t(y) << kCellBits | std::uint64_t(z) << 2 * kCellBits;
}

}  // namespace

CellGrid::CellGrid(const FloatMap& map, const std::vector<const std::vector<MotionBox>*>& sets,
                   std::size_t limit)
    : map_(map) {
  double sum = 0;
  std::size_t count = 0;
  for (const auto* set : sets)
    for (const MotionBox& b : *set) {
      double widest = 0;
      for (std::size_t i = 0; i < 3; ++i)
        widest = std::max(widest, double(map_(std::max(b.hi_t0[i], b.hi_t1[i]), i)) -
                                      double(map_(std::min(b.lo_t0[i], b.lo_t1[i]), i)));
      sum += widest;
      ++count;
    }
  // Half the cells that a bulk of spread 1 could tell apart are the finest worth having.
  const double width = count > 0 ? std::max(2 * sum / double(count), 0x1p-17) : 1;
  for (cells_per_unit_ = 1 / width; entries(sets, limit) > limit;) cells_per_unit_ /= 2;
}

std::uint32_t CellGrid::cell(double x, std::size_t axis) const {
  const double c = std::floor(double(map_(x, axis)) * cells_per_unit_) + kMiddle;
  return std::uint32_t(std::min(std::max(c, 0.0), 2 * kMiddle - 1));
}

CellGrid::Range CellGrid::range(const MotionBox& box) const {
  Range r;
  for (std::size_t i = 0; i < 3; ++i) {
    r.lo[i] = cell(std::min(box.lo_t0[i], box.lo_t1[i]), i);
    r.hi[i] = cell(std::max(box.hi_t0[i], box.hi_t1[i]), i);
  }
  return r;
}

// Stops counting beyond `limit`.
std::size_t CellGrid::entries(const std::vector<const std::vector<MotionBox>*>& sets,
                              std::size_t limit) const {
  std::size_t total = 0;
  for (const auto* set : sets)
    for (const MotionBox& b : *set) {
      const Range r = range(b);
      std::size_t cells = 1;
      for (std::size_t i = 0; i < 3; ++i) cells *= r.hi[i] - r.lo[i] + 1;  // at most 2^60
      total += cells;
      if (total > limit) return total;
    }
  return total;
}

void CellGrid::append(const std::vector<MotionBox>& boxes, bool second, std::vector<Entry>& entries) const {
  for (std::size_t id = 0; id < boxes.size(); ++id) {
    const Range r = range(boxes[id]);
    for (std::uint32_t z = r.lo[2]; z <= r.hi[2]; ++z)
      for (std::uint32_t y = r.lo[1]; y <= r.hi[1]; ++y)
        for (std::uint32_t x = r.lo[0]; x <= r.hi[0]; ++x)
          entries.push_back({pack(x, y, z), int(id), second});
  }
}

std::uint64_t CellGrid::cell_of_pair(const Range& a, const Range& b) {
  return pack(std::max(a.lo[0], b.lo[0]), std::max(a.lo[1], b.lo[1]), std::max(a.lo[2], b.lo[2]));
}

}  // namespace onset
