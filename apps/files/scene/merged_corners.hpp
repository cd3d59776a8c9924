// STL files name no vertices: which of their corners are one.
#pragma once

#include "files/mesh/mesh_file.hpp"

namespace app {

// Corners at exactly the same place in `t0` become one vertex in both, with a note; `t1` may be the same file, or
// have vertices of its own. A face whose corners become two vertices or one is a wire or a point. Throws InputError
// for corners that are at one place in `t0` and not in `t1`: whether they are one vertex, STL cannot say.
void merge_corners(MeshFile& t0, MeshFile& t1);

}  // namespace app
