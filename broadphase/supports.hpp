// Positions as float supports: what the float boxes of the tree are unions of.
#pragma once

#include "base/aligned.hpp"
#include "broadphase/bvh_kernel.hpp"
#include "broadphase/float_map.hpp"
#include "broadphase/motion_box.hpp"

namespace onset {

// One record (layout: bvh_kernel.hpp) a vertex, or a primitive where inflations differ, plus a last one of
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
