// What a rank keeps of a mesh from call to call.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mpi/messages/communicator.hpp"
#include "mpi/messages/halo.hpp"
#include "mpi/scene/numbering.hpp"
#include "onset/mpi/mesh.hpp"
#include "scene/mesh_data.hpp"

namespace onset::mpi {

// How a primitive takes part in steps, as PrimitiveFilter has it for the whole scene.
enum class TakesPart : char { no, moving, still };

// The ids of the vertices within so many edges of each slot, of which row i is [first[i], first[i + 1]).
struct NearVertices {
  int rings = 0;  // 0: not asked for
  std::vector<std::size_t> first;
  std::vector<int> ids;
};

struct Mesh::Impl {
  Communicator comm;
  int dimension = 3;
  std::ptrdiff_t rows = 0, owned = 0;
  // Of the scene; points are the last of the edges.
  std::int64_t vertices = 0, edges = 0, points = 0, faces = 0;

  // By slot: [0, owned) as the caller's rows, then the halo.
  std::vector<int> id, owner;
  Halo halo;
  // The elements owned here, ordered by id, with slots as vertices.
  std::vector<Element<2>> own_edges;
  std::vector<Element<3>> own_faces;
  // Slots in the order of ids.
  std::vector<int> by_id;

  // By slot; empty where no rank has any. has_rules: whether any rank has any.
  bool has_rules = false;
  std::vector<double> thickness;
  std::vector<int> body;
  std::vector<std::uint32_t> group, mask;
  std::vector<char> is_static;
  // The rules of the scene with ids of the scene, and what follows from them and from no vertex.
  CollisionRules tables;
  MeshData checked;
  double thickest = 0;
  NearVertices near;

  // By kind, of what is owned here; `still` ones are wholly static.
  std::array<std::vector<TakesPart>, 3> takes_part;
  bool has_static = false;
  // Of the scene.
  std::int64_t static_vertices = 0;
  // Edges that the choice of a box test samples: place in the sample, and row of own_edges.
  std::vector<std::pair<std::int64_t, int>> samples;

  mutable Exchange exchange;

  std::size_t slots() const { return id.size(); }
  template <std::size_t N>
  bool is_still(const std::array<int, N>& slots) const {
    for (const int s : slots)
      if (is_static.empty() || !is_static[std::size_t(s)]) return false;
    return true;
  }
};

// (c) Says which primitives have a partner in the scene: fills takes_part, has_static.
void find_partners(Mesh::Impl& mesh);
// (c) Fills samples.
void choose_samples(Mesh::Impl& mesh);

}  // namespace onset::mpi
