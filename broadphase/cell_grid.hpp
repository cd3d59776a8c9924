// A uniform grid of cells, and the cells that a box covers.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/stop.hpp"

namespace onset {

// The box of a whole motion, through a FloatMap (broadphase/bvh/float_boxes.hpp).
struct FloatBox {
  std::array<float, 3> lo, hi;
};

// 2^20 cells an axis around the origin; the outermost take all that lies beyond. The cell of a coordinate is
// monotone in it, so boxes that overlap share the cell of the lower corner of their intersection, where their
// pair is reported, once.
class CellGrid {
 public:
  // Makes cells about twice as wide as the mean box, and doubles that until at most `limit` are covered in
  // all, or it is stopped.
  CellGrid(const std::vector<const std::vector<FloatBox>*>& sets, std::size_t limit, const Stop& stop = {});

  // Calls f(cell) for every cell that the box covers.
  template <class F>
  void visit(const FloatBox& box, F&& f) const {
    const Corner lo = corner(box.lo), hi = corner(box.hi);
    for (std::uint32_t z = lo[2]; z <= hi[2]; ++z)
      for (std::uint32_t y = lo[1]; y <= hi[1]; ++y)
        for (std::uint32_t x = lo[0]; x <= hi[0]; ++x) f(number({x, y, z}));
  }

  std::uint64_t cell(const std::array<float, 3>& point) const { return number(corner(point)); }

  // Returns how many cells are covered in all, each once for every box that covers it.
  std::size_t covered() const { return covered_; }

 private:
  static constexpr int kBits = 20;
  using Corner = std::array<std::uint32_t, 3>;

  static std::uint64_t number(const Corner& c) {
    return std::uint64_t(c[0]) | std::uint64_t(c[1]) << kBits | std::uint64_t(c[2]) << 2 * kBits;
  }
  Corner corner(const std::array<float, 3>& point) const;
  bool fits(const std::vector<const std::vector<FloatBox>*>& sets, std::size_t limit);

  double cells_per_unit_ = 1;
  std::size_t covered_ = 0;
};

}  // namespace onset
