// This rank's part of a scene in one call: what it owns, and the ghosts that may meet it.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "mpi/exchange/box_groups.hpp"
#include "mpi/scene/motion_of_parts.hpp"
#include "onset/mesh.hpp"
#include "onset/options.hpp"
#include "scene/pairs/whole_scene.hpp"
#include "src/shared/step_setup.hpp"

namespace onset::mpi {

// Its ids are places in the order of those of the scene, so that whatever is ordered by ids is so by either.
struct Part {
  onset::Mesh mesh;
  // By vertex of the part: x y z, or x y in the plane, at both ends; of a line search its direction in place
  // of the end.
  std::vector<double> x_t0, x_t1;
  std::shared_ptr<const WholeScene> whole;

  Positions start() const { return {x_t0.data(), mesh.num_vertices(), mesh.dimension()}; }
  Positions end() const { return {x_t1.data(), mesh.num_vertices(), mesh.dimension()}; }

  // What ids of the part are in the scene.
  int id_of(Primitive kind, int id) const { return whole->id(kind, id); }
  void rename(Pair& pair) const;
  template <std::size_t N>
  void rename_vertices(std::array<int, N>& vertices) const {
    for (int& v : vertices)
      if (v >= 0) v = id_of(Primitive::vertex, v);
  }
  // The ranks that own vertices of the part.
  std::array<int, 4> owners_of(const Pair& pair) const;
};

// (c) Sends ghosts and makes the part. inflation: how far boxes reach (largest_inflation).
Part make_part(const Mesh::Impl& mesh, OwnMotion&& own, double inflation,
               Meetings meetings = Meetings::contacts);

// What largest_inflation asks of a mesh, for a scene.
MeshData reach_data(const Mesh::Impl& mesh, const WholeScene& whole);

}  // namespace onset::mpi
