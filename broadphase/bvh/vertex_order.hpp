// In which order primitives are stored: vertices along a space-filling curve, edges and faces after their
// vertices.
#pragma once

#include <vector>

#include "broadphase/bvh/float_boxes.hpp"

namespace onset {

// Ids of some primitives of one kind, or all of them: then `ids` is null.
struct IdList {
  const int* ids;
  std::size_t count;
  int operator[](std::size_t i) const { return ids ? ids[i] : int(i); }
};

struct VertexOrder {
  std::vector<int> vertex;  // of each rank
  std::vector<int> rank;    // of each vertex; 0 for those that have none
};

// How far neighbours along the order are apart, relative to vertices half the order apart, from a sample.
double roughness(const VertexOrder& order, const Motion& motion);

VertexOrder make_vertex_order(const Motion& motion, const FloatMap& map, const IdList& vertices);

// Fills ids[0..list.count) by the lowest rank among their vertices; many of one lowest rank by the
// highest. As good as a curve through the primitives' own centres (within 5 % of its traversal times), at the
// price of a counting sort.
void order_primitives(const MeshData& mesh, Primitive kind, const IdList& list, const VertexOrder& order,
                      int* ids);

}  // namespace onset
