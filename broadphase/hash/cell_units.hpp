// Boxes in whole numbers: cells of a uniform grid, and levels of grids whose cells are twice as wide each.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "base/assert.hpp"

namespace onset {

// The box of a whole motion, through a FloatMap (broadphase/bvh/float_boxes.hpp).
struct FloatBox {
  std::array<float, 3> lo, hi;
  float widest() const { return std::max({hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]}); }
};

// The same in units of CellUnits.
struct CellBox {
  std::array<int, 3> lo, hi;
  int widest() const { return std::max({hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]}); }
};

// A cell of level 0 is 2^kSub units wide, one of level l 2^(kSub + l). There are 2^kBits units an axis around
// the origin; the outermost take all that lies beyond. The unit of a coordinate is monotone in it, so boxes
// that overlap do so in units, too.
class CellUnits {
 public:
  static constexpr int kBits = 20, kSub = 3;
  // FloatMap gives the bulk a spread of about 1: with wider cells it stays off the outermost ones.
  static constexpr int kLeastExponent = -13, kMostExponent = 120;

  // Cells of level 0 are 2^exponent wide.
  explicit CellUnits(int exponent) : scale_(std::ldexp(1.0, kSub - exponent)) {}

  CellBox operator()(const FloatBox& box) const {
    CellBox c;
    for (std::size_t i = 0; i < 3; ++i) c.lo[i] = unit(box.lo[i]), c.hi[i] = unit(box.hi[i]);
    return c;
  }

  // Returns the lowest level at which a box is no wider than a cell.
  static int level_of(const CellBox& box) {
    const int wide = box.widest();
    ONSET_ASSERT(wide >= 0 && wide < 1 << kBits);
    return wide <= 1 << kSub ? 0 : 32 - __builtin_clz(unsigned(wide - 1)) - kSub;
  }

 private:
  // Every operation is monotone.
  int unit(float x) const {
    constexpr double kMiddle = 1 << (kBits - 1);
    return int(std::min(std::max(double(x) * scale_ + kMiddle, 0.0), 2 * kMiddle - 1));
  }

  double scale_;
};

}  // namespace onset
