// Which cells of a uniform grid a box covers.
#pragma once

#include <cstdint>
#include <vector>

#include "broadphase/motion_box.hpp"
#include "broadphase/supports.hpp"

namespace onset {

// Cells are counted from the middle of 2^20 an axis, and the outermost take all that lies beyond. The cell of
// a coordinate is monotone in it, so boxes that overlap share the cell of the lower corner of their
// intersection: a pair is reported there.
class CellGrid {
 public:
  struct Range {
    std::array<std::uint32_t, 3> lo, hi;  // inclusive
  };
  struct Entry {
    std::uint64_t cell;
    int id;
    bool second;  // side of the pair
    bool operator<(const Entry& e) const {
      return cell != e.cell ? cell < e.cell : second != e.second ? !second : id < e.id;
    }
  };

  // Cells about twice as wide as the mean box, wider where `limit` entries would not do.
  CellGrid(const FloatMap& map, const std::vector<const std::vector<MotionBox>*>& sets, std::size_t limit);

  Range range(const MotionBox& box) const;
  void append(const std::vector<MotionBox>& boxes, bool second, std::vector<Entry>& entries) const;

  // The cell in which the pair (a, b) is reported; no cell where the boxes do not overlap.
  static std::uint64_t cell_of_pair(const Range& a, const Range& b);

 private:
  std::uint32_t cell(double x, std::size_t axis) const;
  std::size_t entries(const std::vector<const std::vector<MotionBox>*>& sets, std::size_t limit) const;

  FloatMap map_;
  double cells_per_unit_ = 1;
};

}  // namespace onset
