// The order of axes of a motion that is spread over ranks.
#pragma once

#include <array>

#include "mpi/scene/mesh_impl.hpp"
#include "scene/motion/motion.hpp"

namespace onset::mpi {

// (c) Orders them as scene/motion/canonical_axes.hpp does for the whole scene. upper: the largest coordinates
// of the scene, by axis; lower: the largest of those times -1.
std::array<int, 3> scene_axes(const Mesh::Impl& mesh, const Motion& motion, const double* upper,
                              const double* lower);

}  // namespace onset::mpi
