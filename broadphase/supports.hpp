// Positions as float supports: what the float boxes of the tree are unions of.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/aligned.hpp"
#include "broadphase/bvh_kernel.hpp"
#include "broadphase/motion_box.hpp"

namespace onset {

// A monotone map from a coordinate to float. Because it is monotone, disjoint floats mean disjoint doubles
// and strictly overlapping floats mean overlapping doubles, whatever the rounding: no widening is needed, and
// only equal floats leave the question open. Centred on the median and scaled by its spread, so that neither
// the scene's scale nor its offset nor a vertex that has flown off costs the bulk its resolution; what is too
// far out saturates.
struct FloatMap {
  std::array<double, 4> centre{};  // the last is padding

  void set_scale(int exponent) { scale_ = std::ldexp(1.0, exponent), inverse_ = std::ldexp(1.0, -exponent); }
  float operator()(double x, std::size_t axis) const {
    const double y = (x - centre[axis]) * scale_;
    return static_cast<float>(std::min(std::max(y, -kLargest), kLargest)) + 0.0f;  // no -0
  }
  // True for all coordinates of a set: the map is one to one on it.
  bool inverts(float y, double x, std::size_t axis) const { return double(y) * inverse_ + centre[axis] == x; }

 private:
  static constexpr double kLargest = 0x1p120;
  double scale_ = 1, inverse_ = 1;  // powers of two
};

FloatMap make_float_map(const Motion& motion);

// One record (layout: bvh_kernel.hpp) a vertex, or a primitive where inflations differ, plus a last one of
// kNowhere. For the swept test a record has one end, that of the whole motion.
struct Supports {
  AlignedArray<float> records;
  std::size_t count = 0;  // without the last
  int rounded_axes = 0;   // bit i: the map is not one to one on axis i
};

// Of the primitives ids[0..count), each widened by its own inflation.
Supports make_supports(const BroadPhaseInput& input, const FloatMap& map, Primitive kind, const int* ids,
                       std::size_t count);

}  // namespace onset
