// The trees over static primitives, kept with the mesh from call to call.
#pragma once

#include <optional>

#include "broadphase/bvh/box_tree.hpp"

namespace onset {

// The trees are immutable. Whatever is traversed with them must have gone through the same map.
struct StaticTrees {
  StaticTrees(const BroadPhaseInput& input, double inflation);

  // The positions that they were made for.
  std::shared_ptr<const StaticMotion> motion;
  std::array<int, 3> axes;
  double inflation;
  FloatMap map;
  // Whether the map suited the motion that it was made for.
  bool separates;
  VertexOrder order;
  // None for the swept test.
  DiagonalRecords diagonals;
  std::array<std::optional<BoxTree>, 3> trees;
};

// Returns the trees of the mesh where they fit `input`, else makes new ones, which the mesh then keeps;
// `made` says which. The mesh keeps one set for each order of axes, for the swept test and for the others.
std::shared_ptr<const StaticTrees> static_trees(const BroadPhaseInput& input, bool& made);

}  // namespace onset
