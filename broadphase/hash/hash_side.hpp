// The primitives of one kind that move, or that are static, in the order of their cells.
#pragma once

#include <optional>
#include <vector>

#include "broadphase/bvh/box_tree.hpp"
#include "broadphase/hash/cell_order.hpp"

namespace onset {

// The vertices that move, or that are static, with the supports of their boxes.
struct HashVertices {
  double inflation = 0;
  VertexOrder order;  // by ids
  Supports supports;
  DiagonalRecords diagonals;

  HashVertices() = default;
  HashVertices(const BroadPhaseInput& input, const FloatMap& map, bool is_static, const Stop& stop);
};

struct HashSide {
  std::vector<int> ids;
  std::vector<FloatBox> boxes;
  CellOrder cells;
  // Blocks of eight boxes in the order of `cells`. Kernels look at them and the unions of eight of them, long
  // runs are searched from farther up, and all of it tells sides that are apart.
  std::optional<BoxTree> tree;

  // Lists the primitives with the boxes of their whole motion.
  void list(const BroadPhaseInput& input, const FloatMap& map, Primitive kind, bool is_static,
            const HashVertices& vertices, const Stop& stop);
  // Makes the tree of boxes, in the order of the cells.
  void lay_out(const BroadPhaseInput& input, const FloatMap& map, Primitive kind,
               const HashVertices& vertices, const Stop& stop);
};

}  // namespace onset
