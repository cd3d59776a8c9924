// The trees over static primitives, kept with the mesh from call to call.
#pragma once

#include <optional>

#include "broadphase/bvh/box_tree.hpp"

namespace onset {

// Immutable once made. What is compared with it must have gone through the same map.
struct StaticTrees {
  StaticTrees(const BroadPhaseInput& input, double inflation);

  std::shared_ptr<const StaticMotion> motion;  // the positions and axes that it was made for
  std::array<int, 3> axes;
  double inflation;
  FloatMap map;
  bool separates;  // as well as a map can here
  VertexOrder order;
  std::array<std::optional<BoxTree>, 3> trees;
};

// Those of the mesh where they fit `input`, else new ones, which the mesh then keeps: `made` tells. A set of
// its own for each box test and order of axes.
std::shared_ptr<const StaticTrees> static_trees(const BroadPhaseInput& input, bool& made);

}  // namespace onset
