// The motion of what a rank owns, and what all ranks together say of it.
#pragma once

#include <memory>
#include <vector>

#include "mpi/scene/mesh_impl.hpp"
#include "scene/motion/motion.hpp"
#include "scene/pairs/whole_scene.hpp"

namespace onset::mpi {

struct OwnMotion {
  // By slot, with the caller's axes: in the plane the third is 0. Its status is that of the scene, and
  // bad_vertex the id there.
  Motion motion;
  // Of a line search: x y z by slot, which ghosts bring in place of the end of the motion; else empty.
  std::vector<double> direction;
  // What every rank measures alike; owners and ids are not filled.
  WholeScene whole;

  // What is sent of the end of a slot's motion.
  const double* end(int slot) const {
    return direction.empty() ? motion.t1(slot) : direction.data() + 3 * std::size_t(slot);
  }
};

// (c) Takes positions of Mesh::rows() or Mesh::owned() rows, has those of the halo sent, and reduces what
// depends on the whole scene. Throws std::invalid_argument for a wrong shape, or a static vertex that moves.
OwnMotion take_motion(const Mesh::Impl& mesh, const Positions& x_t0, const Positions& x_t1);
// (c) Takes the direction of a motion, whose status is free.
void take_direction(const Mesh::Impl& mesh, const Positions& dx, OwnMotion& own);

}  // namespace onset::mpi
