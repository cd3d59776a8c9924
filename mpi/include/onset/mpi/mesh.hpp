// A mesh whose vertices and elements are spread over the ranks of an MPI communicator.
#pragma once

#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <onset/collision_rules.hpp>
#include <onset/export.hpp>
#include <onset/views.hpp>
#include <vector>

namespace onset::mpi {

// What one rank knows of a scene. Ids are those of the scene as one process would have it in a onset::Mesh:
// rows of its positions, of its edges and of its faces, each in [0, number of these). They fit into an int,
// which holds for a surface of 10^9 triangles.
struct MeshPart {
  // The id of each row of this rank's positions. Rows [0, owned) are owned here: each vertex is owned by one
  // rank. The others are ghosts, vertices of this rank's elements that another rank owns; what is said of
  // them here (positions, rules) is not read, since their owner says it.
  std::vector<int> vertex_ids;
  std::ptrdiff_t owned = 0;
  // Elements as rows of this rank, and their ids. An element may be given by every rank that knows it, with
  // its vertices in the same order; the lowest of these ranks owns it.
  Indices faces;
  std::vector<int> face_ids;
  // Where no rank gives edges, they are those of the faces, numbered as onset::edges numbers them.
  Indices edges;
  std::vector<int> edge_ids;
  // 3, or 2: in the plane, with edges and no faces.
  int dimension = 3;
  // Rules that have a value for each vertex (thickness, bodies, static_vertices, groups, masks) have one for
  // each row here; `points` are rows, and `point_ids` their places in the list of the scene. All others are
  // the same on all ranks, with ids of the scene. rest_positions is refused.
  CollisionRules rules;
  std::vector<int> point_ids;
};

// What a call sent and did on this rank.
struct Exchange {
  // Primitives owned here, and those of other ranks that were sent here, by kind: vertices, edges, faces.
  // Among the vertices are those of edges and faces that are there.
  std::int64_t owned[3] = {}, ghosts[3] = {};
  // Sent to other ranks, ghosts and all that the call needs besides; reductions are not counted.
  std::int64_t bytes_sent = 0, messages_sent = 0;
  // Pairs handed to the narrow phase here.
  std::int64_t pairs = 0;
};

// Functions marked (c), among them the constructor, are collective: all ranks of the communicator call them,
// in the same order, with the same options. They fail together: what is thrown on one rank is thrown on all,
// with the number of the lowest rank in its text where it was one that failed.
//
// Immutable. Calls on one mesh are made by one thread at a time, the one that MPI lets make calls.
class ONSET_API Mesh {
 public:
  // (c) Duplicates the communicator. Throws std::invalid_argument naming the row or the id where a part does
  // not fit the others: an id that no rank owns, or two; an element that no rank gives; rules of the scene
  // that are not the same on all ranks; and for all that makes onset::Mesh throw.
  Mesh(MPI_Comm comm, const MeshPart& part);
  ~Mesh();  // (c) while MPI runs
  Mesh(Mesh&&) noexcept;
  Mesh& operator=(Mesh&&) noexcept;

  int rank() const noexcept;
  int size() const noexcept;
  int dimension() const noexcept;
  // Of the whole scene.
  std::int64_t num_vertices() const noexcept;
  std::int64_t num_edges() const noexcept;
  std::int64_t num_faces() const noexcept;
  // Of this rank: rows of positions, and those of them that are owned here.
  std::ptrdiff_t rows() const noexcept;
  std::ptrdiff_t owned() const noexcept;

  // What the latest call on this mesh exchanged.
  const Exchange& exchange() const noexcept;

  struct Impl;  // mpi/scene/mesh_impl.hpp
  const Impl& impl() const noexcept { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace onset::mpi
