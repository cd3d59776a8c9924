// The kinds of primitives: their counts, their vertices, and which is on each side of a pair.
#pragma once

#include <array>
#include <cstddef>

#include "base/assert.hpp"
#include "onset/result.hpp"
#include "scene/mesh_data.hpp"

namespace onset {

enum class Primitive { vertex, edge, face };

inline constexpr std::array<Primitive, 3> kPrimitives{Primitive::vertex, Primitive::edge, Primitive::face};

inline std::size_t primitive_count(const MeshData& mesh, Primitive kind) {
  switch (kind) {
    case Primitive::edge:
      return mesh.edges.size();
    case Primitive::face:
      return mesh.faces.size();
    default:
      return std::size_t(mesh.num_vertices);
  }
}

// Returns the vertices of a primitive; unused places repeat the first.
inline std::array<int, 3> primitive_vertices(const MeshData& mesh, Primitive kind, int id) {
  ONSET_ASSERT(id >= 0 && std::size_t(id) < primitive_count(mesh, kind));
  switch (kind) {
    case Primitive::edge: {
      const auto& e = mesh.edges[std::size_t(id)];
      return {e[0], e[1], e[0]};
    }
    case Primitive::face:
      return mesh.faces[std::size_t(id)];
    default:
      return {id, id, id};
  }
}

// Return the kind of primitive on each side of a pair.
inline Primitive first_primitive(PairKind kind) {
  return kind == PairKind::vertex_face || kind == PairKind::vertex_edge ? Primitive::vertex : Primitive::edge;
}
inline Primitive second_primitive(PairKind kind) {
  return kind == PairKind::edge_edge || kind == PairKind::vertex_edge ? Primitive::edge : Primitive::face;
}

// The kinds of pairs that a step may have, in their order.
inline constexpr std::array<PairKind, 3> kStepKinds{PairKind::vertex_face, PairKind::edge_edge,
                                                    PairKind::vertex_edge};
// Whether a mesh has pairs of a kind.
inline bool has_kind(const MeshData& mesh, PairKind kind) {
  return (kind == PairKind::vertex_edge) == (mesh.dimension == 2);
}
// The pairs of positions at rest whose common points are intersections.
inline PairKind intersection_kind(const MeshData& mesh) {
  return mesh.dimension == 2 ? PairKind::edge_edge : kEdgeFace;
}

}  // namespace onset
