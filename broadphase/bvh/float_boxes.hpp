// Coordinates in single precision, in a way that cannot lose an overlap.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "base/aligned.hpp"
#include "broadphase/bvh/kernel.hpp"
#include "broadphase/motion_box.hpp"
#include "scene/motion/motion.hpp"

namespace onset {

// A monotone map from a coordinate to float. Because it is monotone, disjoint floats mean disjoint doubles
// and strictly overlapping floats mean overlapping doubles, whatever the rounding: no widening is needed, and
// only equal floats leave the question open. Never gives -0.
//
// Linear, centred on the median and scaled by its spread, so that neither the scene's scale nor its offset
// nor a vertex that has flown off costs the bulk its resolution; what is too far out saturates. Where that
// would not tell the vertices apart (two clusters that are small against their distance), piecewise linear
// between quantiles of the coordinates.
class FloatMap {
 public:
  static constexpr float kLargest = 0x1p120f;  // what is farther out becomes this

  explicit FloatMap(const Motion& motion);

  // Whether it tells the vertices of this motion apart, mostly: a map made for another motion is as correct,
  // but may leave many pairs to be decided in double.
  bool suits(const Motion& motion) const;

  float operator()(double x, std::size_t axis) const {
    if (!knots_[axis].empty()) return between_knots(x, axis);
    return to_float((x - centre_[axis]) * scale_);
  }
  // Linear but for the rounding to float, as far as coordinates stay below kLargest.
  bool is_linear() const { return knots_[0].empty() && knots_[1].empty() && knots_[2].empty(); }
  // Where it holds for all coordinates of a set, the map is one to one on them.
  bool inverts(float y, double x, std::size_t axis) const {
    return double(y) * inverse_ + centre_[axis] == x && knots_[axis].empty();
  }

 private:
  static float to_float(double y) {
    return static_cast<float>(std::min(std::max(y, -double(kLargest)), double(kLargest))) + 0.0f;
  }

  void fit_linear(const std::array<std::vector<double>, 3>& samples);
  bool separates(const std::array<std::vector<double>, 3>& samples) const;
  float between_knots(double x, std::size_t axis) const;

  std::array<double, 4> centre_{};            // the last is for padding
  double scale_ = 1, inverse_ = 1;            // powers of two
  std::array<std::vector<double>, 4> knots_;  // ascending; empty: linear
};

// One record (layout: kernel.hpp) a vertex, or a primitive where inflations differ, plus a last one of
// kNowhere. For the swept test a record has one end, that of the whole motion.
struct Supports {
  AlignedArray<float> records;
  std::size_t count = 0;  // without the last
  int rounded_axes = 0;   // bit i: the map is not one to one on axis i
};

// Of the primitives ids[0..count), each widened by `inflation` and its own thickness.
Supports make_supports(const BroadPhaseInput& input, double inflation, const FloatMap& map, Primitive kind,
                       const int* ids, std::size_t count);

}  // namespace onset
