// Scenes of any size, for curves of cost over size.
#pragma once

#include <cstdint>

#include "files/mesh/mesh_file.hpp"

namespace app {

struct Frames {
  Points x_t0, x_t1;
  Faces faces;
};

// Two rippled sheets of about `triangles` triangles in all, one above the other. In the step the upper one
// comes down and slides by a fixed number of edge lengths, so that it passes into the lower one over part of
// the area: sheets of every size look the same from near, and candidates and contacts grow with the number of
// triangles.
Frames layered_cloth(std::int64_t triangles);

// Two flat sheets of about `triangles` triangles in all that lie on one another, up to rounding. In the step
// ripples of the upper one press it on the lower one in half of the area and part the two in the other.
Frames resting_plates(std::int64_t triangles);

// Two flat sheets on the same grid, 1.5 edge lengths apart, of which the upper one moves by a tenth of an
// edge length: a mesh at rest.
Frames still_sheets(std::int64_t triangles);

// Each triangle divided into four at the midpoints of its edges, `times` over, in both frames: the same
// scene, finer.
Frames refined(Frames frames, int times);

}  // namespace app
