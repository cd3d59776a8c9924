// The meshes of a step on which some vertices turn: which pairs go through which pipeline.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "onset/mesh.hpp"
#include "onset/trajectory.hpp"
#include "scene/mesh_data.hpp"
#include "scene/pair_sink.hpp"
#include "scene/primitive_filter.hpp"

namespace onset {

// A mesh with the rules of another and fewer pairs, by what turns. Whoever has one has it alone; a mesh keeps
// it for the next call, as none of it depends on positions but what is said to.
//
// - linear: pairs of two linear primitives, which the linear pipeline decides in one step.
// - rest: pairs within one rigid body, which stay as they are at the start.
// - pieces: pairs with a primitive that turns, decided in pieces of time. Those within one rigid body are
// left
//   out. So are those of two linear primitives, as far as body keys can say so: what is found of them is
//   dropped (is_of_pieces).
struct TurningScene {
  // Throws std::invalid_argument for a static vertex that is not linear.
  TurningScene(const Mesh& mesh, std::vector<int> bodies);

  // Trajectory::body of each vertex.
  std::vector<int> body;
  // All vertices that are not linear.
  std::vector<int> turning_vertices;
  Mesh linear, rest;
  bool has_rest = false;
  // That of `rest`. Its thickness is that of one question.
  std::shared_ptr<MeshData> rest_data;
  // Its thickness and lists are those of one piece, and of one call; `filter` is its filter.
  std::shared_ptr<MeshData> pieces;
  std::shared_ptr<PrimitiveFilter> filter;
  // Of the mesh: empty where it has none.
  std::vector<double> thickness;
  // The primitives with a vertex that is not linear, and the others, that take part.
  std::array<std::vector<int>, 3> turning, others;
  // Whether all that turns is one rigid body, which does not meet itself in pieces of time.
  bool is_one_body = true;

  // Lets only these of `others` take part in the pieces.
  void list(const std::array<std::vector<int>, 3>& near);
  // The mesh's thickness, and with it what storing vertices of rigid bodies can bring them closer: the
  // largest of each primitive's sum is at least the sum of its largest. None where a bound is not usable.
  std::optional<std::vector<double>> widened_at_rest(const Trajectory& trajectory) const;
  // Whether a pair has a vertex that is not linear.
  bool is_of_pieces(PairKind kind, IdPair pair) const;
  // Whether all vertices of a pair are in one rigid body.
  bool is_of_one_body(PairKind kind, IdPair pair) const;
};

// Returns Trajectory::body of each vertex. Throws std::invalid_argument for a number of vertices that is not
// the mesh's, and a body out of range.
std::vector<int> bodies_of(const Mesh& mesh, const Trajectory& trajectory);

// Takes the scene that an earlier call left on the mesh, or makes one.
std::shared_ptr<TurningScene> take_turning_scene(const Mesh& mesh, std::vector<int> bodies);
void give_back(const Mesh& mesh, std::shared_ptr<TurningScene> scene);

}  // namespace onset
