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

// Edges against faces, which only the checks of positions at rest ask about; a step has no such pairs.
inline constexpr PairKind kEdgeFace = PairKind(2);

// Return the kind of primitive on each side of a pair.
inline Primitive first_primitive(PairKind kind) {
  return kind == PairKind::vertex_face ? Primitive::vertex : Primitive::edge;
}
inline Primitive second_primitive(PairKind kind) {
  return kind == PairKind::edge_edge ? Primitive::edge : Primitive::face;
}

}  // namespace onset
