// Coordinates and boxes in single precision, rounded so that no overlap is lost.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/aligned.hpp"
#include "broadphase/bvh/kernel.hpp"
#include "broadphase/motion_box.hpp"
#include "scene/motion/motion.hpp"

namespace onset {

// A monotone map from coordinates to floats, so that overlaps are kept without widening and only equal floats
// leave them open (docs/theory.md, L32). It never gives -0.
//
// It is linear, centred on the median and scaled by the spread, so that neither the scene's scale or offset
// nor a vertex that has flown off costs the bulk its resolution; what is too far out saturates. Where that
// would not tell vertices apart (small clusters far from each other), it is piecewise linear between
// quantiles.
class FloatMap {
 public:
  // What is farther out becomes this.
  static constexpr float kLargest = 0x1p120f;

  explicit FloatMap(const Motion& motion);

  // Says whether it mostly tells the vertices of this motion apart. A map that does not is as correct, but
  // leaves many pairs to be decided in double.
  bool suits(const Motion& motion) const;

  float operator()(double x, std::size_t axis) const {
    if (!knots_[axis].empty()) return between_knots(x, axis);
    return to_float((x - centre_[axis]) * scale_);
  }
  // Says whether it is linear, but for rounding to float, where floats stay below kLargest.
  bool is_linear() const { return knots_[0].empty() && knots_[1].empty() && knots_[2].empty(); }
  // Says whether coordinates of up to this magnitude stay below kLargest, where it is linear.
  bool keeps(double magnitude) const {
    double furthest = 0;
    for (const double c : centre_) furthest = std::max(furthest, (magnitude + std::fabs(c)) * scale_);
    return furthest < 0.5 * double(kLargest);
  }
  // Says whether y gives x back. The map is one to one on a set where this holds for all of it.
  bool inverts(float y, double x, std::size_t axis) const {
    return double(y) * inverse_ + centre_[axis] == x && knots_[axis].empty();
  }
  // Its linear part, wherever it is linear itself.
  LinearMap linear_part() const { return {{centre_[0], centre_[1], centre_[2]}, scale_}; }
  // Fills in what a kernel needs to know of it; only where it is linear.
  void describe(SupportArguments& arguments) const {
    for (std::size_t a = 0; a < 4; ++a) arguments.centre[a] = centre_[a];
    arguments.scale = scale_, arguments.inverse = inverse_;
  }

 private:
  static float to_float(double y) {
    return static_cast<float>(std::min(std::max(y, -double(kLargest)), double(kLargest))) + 0.0f;
  }

  void fit_linear(const std::array<std::vector<double>, 3>& samples);
  bool separates(const std::array<std::vector<double>, 3>& samples) const;
  float between_knots(double x, std::size_t axis) const;

  std::array<double, 4> centre_{};            // the last is padding
  double scale_ = 1, inverse_ = 1;            // powers of two
  std::array<std::vector<double>, 4> knots_;  // ascending; empty: linear
};

// A record (FitArguments::supports) of each vertex, or primitive where inflations differ, and a last one of
// kNowhere. For the swept test a record has one end, that of the whole motion.
struct Supports {
  AlignedArray<float> records;
  // Without the last.
  std::size_t count = 0;
  // Bit i: the map is not one to one on axis i.
  int rounded_axes = 0;
};

// Where the record of the i-th primitive goes: at its place in the list, or at its id.
struct RecordsAt {
  float* records;
  std::size_t stride;
  bool by_id;
  float* operator()(std::size_t i, int id) const { return records + (by_id ? std::size_t(id) : i) * stride; }
};

// Writes the records of the primitives ids[0..count), each widened by `inflation` and its own thickness; not
// all of them where it was stopped. Returns Supports::rounded_axes.
int write_supports(const BroadPhaseInput& input, double inflation, const FloatMap& map, Primitive kind,
                   const int* ids, std::size_t count, const RecordsAt& at, const Stop& stop = {});

// Makes the supports of the primitives ids[0..count), each widened by `inflation` and its own thickness; not
// all of them where it was stopped.
Supports make_supports(const BroadPhaseInput& input, double inflation, const FloatMap& map, Primitive kind,
                       const int* ids, std::size_t count, const Stop& stop = {});

}  // namespace onset
