// Writes a mesh with a colour for each vertex, for MeshLab and the like.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "files/mesh/mesh_file.hpp"

namespace app {

using Colour = std::array<std::uint8_t, 3>;  // red, green, blue

// From red for the earliest time over yellow to blue for 1; grey for a vertex without contact (toi < 0).
Colour colour_of(double toi, double earliest);

// PLY, ascii. Throws InputError naming the path where it cannot be written.
void write_coloured_ply(const std::string& path, const Points& positions, const Faces& faces,
                        const std::vector<Colour>& colours);

}  // namespace app
