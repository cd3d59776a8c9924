// The built-in scene: a cloth folded in two drops on a sphere.
#pragma once

#include <cstddef>

#include "files/mesh/mesh_file.hpp"

namespace app {

struct DemoScene {
  Points x_t0, x_t1;
  Faces faces;
  std::ptrdiff_t cloth_faces = 0, sphere_faces = 0;  // the cloth comes first
};

// Nothing touches at the start; during the step the lower layer meets the sphere, and later the upper layer
// the lower one.
DemoScene make_demo_scene();

}  // namespace app
