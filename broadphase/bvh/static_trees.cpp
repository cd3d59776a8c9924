#include "broadphase/bvh/static_trees.hpp"

#include "scene/static_cache.hpp"

namespace onset {

FixedTrees::FixedTrees(const BroadPhaseInput& input, double by)
    : motion(input.motion.fixed), inflation(by), map(input.motion), separates(map.suits(input.motion)) {
  const PrimitiveFilter& filter = *input.mesh.filter;
  order = make_vertex_order(input.motion, map, {filter.fixed_vertices.data(), filter.fixed_vertices.size()});
  const Supports vertices =
      make_supports(input, by, map, Primitive::vertex, order.vertex.data(), order.vertex.size());
  for (const Primitive kind : kPrimitives) {
    const std::vector<int>& ids = filter.fixed[std::size_t(kind)];
    auto& tree = trees[std::size_t(kind)];
    tree.emplace(input.mesh, kind, IdList{ids.data(), ids.size()}, order, false);
    tree->fit(input, by, map, vertices);
  }
}

std::shared_ptr<const FixedTrees> fixed_trees(const BroadPhaseInput& input, bool& made) {
  const FixedCache::Slot slot = FixedCache::trees(input.test == BoxTest::swept, input.motion.axes);
  const double inflation = part_inflation(input, true);
  auto trees = input.mesh.fixed_cache->get<FixedTrees>(slot);
  made = !trees || !input.motion.fixed || trees->motion != input.motion.fixed ||
         trees->inflation != inflation || (trees->separates && !trees->map.suits(input.motion));
  if (!made) return trees;
  trees = std::make_shared<const FixedTrees>(input, inflation);
  input.mesh.fixed_cache->put(slot, trees);
  return trees;
}

}  // namespace onset
