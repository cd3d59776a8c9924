// Polygons as triangles.
#pragma once

#include "files/mesh/mesh_file.hpp"

namespace app {

// In the order of the polygons. A polygon of n corners becomes n - 2 triangles of the same winding, by
// cutting off ears in the plane that it lies in best: one that is planar and does not cross itself is covered
// exactly. Throws InputError where that takes too long.
Faces triangulate(const MeshFile& file);

}  // namespace app
