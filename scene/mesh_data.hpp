// The arrays behind a Mesh, and what follows from them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "onset/collision_rules.hpp"
#include "onset/export.hpp"
#include "scene/static_cache.hpp"

namespace onset {

struct MeshPlanes;       // scene/planes.hpp
struct PrimitiveFilter;  // scene/primitive_filter.hpp
struct RestShape;        // scene/pairs/rest_limits.hpp
class VertexRings;       // scene/pairs/vertex_rings.hpp
struct WholeScene;       // scene/pairs/whole_scene.hpp

// A separation of the pairs of two bodies, first <= second.
struct SeparationOfBodies {
  int first, second;
  double separation;
};

// Returns the filter of a mesh without rules: see MeshData::filter.
ONSET_API std::shared_ptr<const PrimitiveFilter> all_primitives();

// Edges against faces, which only the checks of positions at rest ask about; a step has no such pairs. The
// last kind of all.
inline constexpr PairKind kEdgeFace = PairKind(4);
inline constexpr std::size_t kPairKinds = 5;

struct MeshData {
  int num_vertices = 0, num_points = 0;
  // 3, or 2: in the plane, with no faces; positions are then stored with z = 0.
  int dimension = 3;
  // The last num_points are points: {v, v} for a vertex of no other edge or face.
  std::vector<std::array<int, 2>> edges;
  std::vector<std::array<int, 3>> faces;
  // A vertex each, >= 0; empty: none.
  std::vector<double> thickness;
  // Of a part of a scene: the largest anywhere in it.
  double thickest_elsewhere = 0;
  // By (first, second), each once; in place of the separation of a call.
  std::vector<SeparationOfBodies> body_separations;
  // Null where the shape at rest lowers no separation.
  std::shared_ptr<const RestShape> rest;
  // Whether vertices at one place at both ends of a motion count as one.
  bool weld = false;

  // The following say who may meet whom; each is empty where no rule sets it.
  // By vertex; empty: all are in body 0.
  std::vector<int> body;
  std::vector<bool> is_static;
  // By body.
  std::vector<bool> rigid, no_self;
  // By vertex.
  std::vector<std::uint32_t> group, mask;
  // Sorted, each once, the smaller id first.
  std::vector<std::array<int, 2>> excluded_bodies, excluded_vertices;
  // By kind; ids as in IdPair, sorted, each once.
  std::array<std::vector<std::array<int, 2>>, kPairKinds> excluded_pairs;
  // Null where pairs are left out only for a vertex that they share.
  std::shared_ptr<const VertexRings> rings;

  // As the rules have them.
  std::vector<Plane> planes;

  // The rules as they were given; null in the mesh of a single query.
  std::shared_ptr<const CollisionRules> rules;

  // The id in the full mesh, by vertex; empty: the same id.
  std::vector<int> full_vertex;
  int num_full_vertices = 0;

  // What finish_mesh makes of all this. Never null: at first every primitive takes part, moves, and may meet
  // all that it shares no vertex with.
  std::shared_ptr<const PrimitiveFilter> filter = all_primitives();
  // Null where there is no plane.
  std::shared_ptr<const MeshPlanes> mesh_planes;
  // Not null where the filter has static primitives.
  std::shared_ptr<StaticCache> static_cache;
  // Not null after finish_mesh.
  std::shared_ptr<BroadPhasePool> broad_phases;
  std::shared_ptr<TurningScenePool> turning_scenes;

  // Null where the mesh is no part of a larger scene.
  std::shared_ptr<const WholeScene> whole;
};

// Returns the largest id of a body + 1.
inline int count_bodies(const MeshData& mesh) {
  return mesh.body.empty() ? 1 : *std::max_element(mesh.body.begin(), mesh.body.end()) + 1;
}

// The rigid body that a vertex is in, or -1.
inline int rigid_body(const MeshData& mesh, int vertex) {
  const std::size_t body = mesh.body.empty() ? 0 : std::size_t(mesh.body[std::size_t(vertex)]);
  return body < mesh.rigid.size() && mesh.rigid[body] ? int(body) : -1;
}

// Returns the largest value of the vertices [first, last), which have one each, >= 0, or all have none.
inline double largest_of(const std::vector<double>& values, const int* first, const int* last) {
  double r = 0;
  for (; first != last && !values.empty(); ++first) r = std::max(r, values[std::size_t(*first)]);
  return r;
}

// Returns the largest thickness of the vertices [first, last).
inline double thickest(const MeshData& mesh, const int* first, const int* last) {
  return largest_of(mesh.thickness, first, last);
}

// The largest thickness of all vertices.
inline double thickest(const MeshData& mesh) {
  if (mesh.thickness.empty()) return mesh.thickest_elsewhere;
  return std::max(mesh.thickest_elsewhere, *std::max_element(mesh.thickness.begin(), mesh.thickness.end()));
}

}  // namespace onset
