#include "broadphase/bvh/static_trees.hpp"

#include "scene/static_cache.hpp"

namespace onset {
namespace {

std::size_t slot_of(bool swept, const std::array<int, 3>& axes) {
  return std::size_t(swept) * 9 + std::size_t(3 * axes[0] + axes[1]);
}

}  // namespace

StaticTrees::StaticTrees(const BroadPhaseInput& input, double by)
    : motion(input.motion.static_part), inflation(by), map(input.motion), separates(map.suits(input.motion)) {
  const PrimitiveFilter& filter = *input.mesh.filter;
  order =
      make_vertex_order(input.motion, map, {filter.static_vertices.data(), filter.static_vertices.size()});
  const Supports vertices =
      make_supports(input, by, map, Primitive::vertex, order.vertex.data(), order.vertex.size());
  const bool motion_boxes = input.test != BoxTest::swept;
  if (motion_boxes)  // these have not moved by any time
    diagonals.write(input, 1, map.linear_part(), order.vertex.data(), order.vertex.size(),
                    order.vertex.size(), false);
  for (const Primitive kind : kPrimitives) {
    const std::vector<int>& ids = filter.statics[std::size_t(kind)];
    auto& tree = trees[std::size_t(kind)];
    tree.emplace(input.mesh, kind, IdList{ids.data(), ids.size()}, order, false);
    tree->fit(input, by, map, vertices, motion_boxes ? &diagonals : nullptr);
  }
}

std::shared_ptr<const StaticTrees> static_trees(const BroadPhaseInput& input, bool& made) {
  const std::size_t slot = slot_of(input.test == BoxTest::swept, input.motion.axes);
  const double inflation = part_inflation(input, true);
  auto trees = input.mesh.static_cache->trees.get(slot);
  made = !trees || !input.motion.static_part || trees->motion != input.motion.static_part ||
         trees->inflation != inflation || (trees->separates && !trees->map.suits(input.motion));
  if (!made) return trees;
  trees = std::make_shared<const StaticTrees>(input, inflation);
  input.mesh.static_cache->trees.put(trees, slot);
  return trees;
}

}  // namespace onset
