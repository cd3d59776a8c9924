// Positions as float supports: what the float boxes of the tree are unions of.
#pragma once

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
  std::array<double, 3> centre{};
  double scale = 1;  // a power of two

  float operator()(double x, std::size_t axis) const {
    const double y = (x - centre[axis]) * scale;
    return static_cast<float>(y < -kLargest ? -kLargest : y > kLargest ? kLargest : y);
  }
  // True for all coordinates of a set: the map is one to one on it.
  bool inverts(float y, double x, std::size_t axis) const {
    return double(y) * (1 / scale) + centre[axis] == x;
  }

 private:
  static constexpr double kLargest = 0x1p120;
};

FloatMap make_float_map(const Motion& motion);

// One record of kSupportStride floats a vertex (layout: bvh_kernel.hpp), or a primitive where inflations
// differ, plus a last one of kNowhere. For the swept test a record has one end, that of the whole motion.
struct Supports {
  AlignedArray<float> records;
  std::size_t count = 0;  // without the last
  int rounded_axes = 0;   // bit i: the map is not one to one on axis i

  const float* record(std::size_t i) const { return records.data() + i * kSupportStride; }
};

// Of the vertices, each widened by the uniform inflation; kinds without thickness.
Supports vertex_supports(const BroadPhaseInput& input, const FloatMap& map);
// Of primitives, each widened by its own inflation.
Supports primitive_supports(const BroadPhaseInput& input, const FloatMap& map, Primitive kind);

}  // namespace onset
