// Which pairs a mesh can have at all, and what left the others out. Plain data.
#pragma once

#include <cstdint>

namespace onset {

// Pairs of one kind, from topology and rules alone: exact, the same for every step and broad phase.
struct PairFilterCounts {
  // All: vertex-face: #V #F; edge-edge: #E (#E - 1) / 2; of a mesh in the plane #V #E and no others. #E is
  // with CollisionRules::points.
  std::int64_t pairs = 0;
  // Those left out, each pair under the first reason that holds.
  // By groups and masks (CollisionRules::groups); see FilterCounts for very many of them.
  std::int64_t masked = 0;
  // Both primitives are static.
  std::int64_t both_static = 0;
  // Both are in one body that is rigid or does not collide with itself.
  std::int64_t same_body = 0;
  // They share a vertex.
  std::int64_t adjacent = 0;
  // Named by CollisionRules::excluded_bodies and the like.
  std::int64_t excluded = 0;
  // Neighbours on the mesh (CollisionRules::excluded_rings).
  std::int64_t within_rings = 0;
  std::int64_t may_meet() const noexcept {
    return pairs - masked - both_static - same_body - adjacent - excluded - within_rings;
  }
};

// Primitives of one kind.
struct PrimitiveFilterCounts {
  // Those that take part; statics: all vertices are static.
  std::int64_t moving = 0, statics = 0;
  // Those that the rules let meet nothing, shared vertices apart: they get no box.
  std::int64_t dropped = 0;
};

// What Mesh::filter_counts() and Stats::filter_counts say. Where more than 1,024 different combinations of
// group and mask occur, masked pairs are not counted (0), and no primitive is dropped on their account; they
// are left out all the same.
struct FilterCounts {
  PairFilterCounts vertex_face, edge_edge, vertex_edge;
  PrimitiveFilterCounts vertices, edges, faces;
};

}  // namespace onset
