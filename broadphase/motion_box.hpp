// The box of a primitive at both ends of the motion, exact in double, and the test on it that defines a
// candidate.
#pragma once

#include <array>
#include <vector>

#include "broadphase/broad_phase.hpp"

namespace onset {

enum class Primitive { vertex, edge, face };

// Closed boxes of the primitive at t = 0 and at the horizon, widened by its inflation (rounded outward; exact
// without one).
struct MotionBox {
  std::array<double, 3> lo_t0, hi_t0, lo_t1, hi_t1;
};

std::size_t primitive_count(const MeshData& mesh, Primitive kind);

// Vertex ids of a primitive; unused places repeat the first.
inline std::array<int, 3> primitive_vertices(const MeshData& mesh, Primitive kind, int id) {
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

// What is on each side of a pair.
inline Primitive first_primitive(PairKind kind) {
  return kind == PairKind::vertex_face ? Primitive::vertex : Primitive::edge;
}
inline Primitive second_primitive(PairKind kind) {
  return kind == PairKind::vertex_face ? Primitive::face : Primitive::edge;
}

// Upper bound on inflation + largest thickness of the primitive's vertices.
double primitive_inflation(const BroadPhaseInput& input, Primitive kind, int id);

MotionBox motion_box(const BroadPhaseInput& input, Primitive kind, int id);
std::vector<MotionBox> motion_boxes(const BroadPhaseInput& input,
                                    Primitive kind);  // of all primitives, by id

// The definition of both tests, which every method reduces to. Swept: closed swept boxes overlap. Motion: no
// axis separates strictly, on the same side, at both ends.
bool boxes_pass(BoxTest test, const MotionBox& a, const MotionBox& b);

bool share_vertex(const MeshData& mesh, PairKind kind, int a, int b);

}  // namespace onset
