// Two frames of one mesh: the input of step, active-set and candidates.
#pragma once

#include <onset/onset.hpp>
#include <string>

#include "mesh_file.hpp"

namespace app {

struct Scene {
  onset::Mesh mesh;  // edges in the order of onset::edges(faces)
  Points x_t0, x_t1;
};

// Throws InputError: what read_mesh throws, an id out of range, a face with a repeated vertex, different
// topology.
Scene read_scene(const std::string& path_t0, const std::string& path_t1);

}  // namespace app
