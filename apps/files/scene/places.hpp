// Vertices at exactly the same place: which they are, and one in place of the corners of an STL file, which
// names no vertices.
#pragma once

#include <array>
#include <vector>

#include "files/mesh/mesh_file.hpp"

namespace app {

// For each row the first row that is the same; -0 and 0 are.
std::vector<Eigen::Index> first_at_place(const Points& x);

// {first vertex at a place, another one there}, by both, of those that are together in both frames.
std::vector<std::array<int, 2>> copies_together(const Points& x_t0, const Points& x_t1);

// Corners at exactly the same place in `t0` become one vertex in both, with a note; `t1` may be the same
// file, or have vertices of its own. A face whose corners become two vertices or one is a wire or a point.
// Throws InputError for corners that are at one place in `t0` and not in `t1`: whether they are one vertex,
// STL cannot say.
void merge_corners(MeshFile& t0, MeshFile& t1);

}  // namespace app
