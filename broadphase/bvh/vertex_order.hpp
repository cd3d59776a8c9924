// The order of primitives in a tree: vertices along a space-filling curve, edges and faces by their vertices.
#pragma once

#include <vector>

#include "broadphase/bvh/float_boxes.hpp"

namespace onset {

// The ids of some primitives of one kind; `ids` is null where it is all of them.
struct IdList {
  const int* ids;
  std::size_t count;
  int operator[](std::size_t i) const { return ids ? ids[i] : int(i); }
};

struct VertexOrder {
  // The vertex of each rank.
  std::vector<int> vertex;
  // The rank of each vertex; 0 for those that have none.
  std::vector<int> rank;
};

// Returns, from a sample, the distance of neighbours in the order relative to that of vertices half the order
// apart.
double roughness(const VertexOrder& order, const Motion& motion);

// Orders `vertices` along the curve, by the middle of their motion. Not to be used where it was stopped.
VertexOrder make_vertex_order(const Motion& motion, const FloatMap& map, const IdList& vertices,
                              const Stop& stop = {});

// Fills ids[0..list.count) in the order of the lowest rank among their vertices, and many of one lowest rank
// by the highest. Traversal is within 5 % of that along a curve through their own centres, and ordering costs
// a counting sort. Returns false where it was stopped.
bool order_primitives(const MeshData& mesh, Primitive kind, const IdList& list, const VertexOrder& order,
                      int* ids, const Stop& stop = {});

}  // namespace onset
