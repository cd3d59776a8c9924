// In which order primitives are stored: vertices along a space-filling curve, edges and faces after their
// vertices.
#pragma once

#include <vector>

#include "broadphase/supports.hpp"

namespace onset {

struct VertexOrder {
  std::vector<int> vertex;  // of each rank
  std::vector<int> rank;    // of each vertex
};

VertexOrder make_vertex_order(const Motion& motion, const FloatMap& map);

// Fills ids[0..number of primitives) by the lowest rank among their vertices; many of one lowest rank by the
// highest. As good as a curve through the primitives' own centres (within 5 % of its traversal times), at the
// price of a counting sort.
void order_primitives(const MeshData& mesh, Primitive kind, const VertexOrder& order, int* ids);

}  // namespace onset
