// The readers of each format: from the bytes of a file to its mesh.
#pragma once

#include <string>
#include <string_view>

#include "files/mesh/mesh_file.hpp"

namespace app {

// Wavefront OBJ: v, f, l, p. Normals, textures, groups and materials are skipped, as are keywords that are not
// OBJ's, with a note; curves, surfaces and calls of other files are refused.
MeshFile read_obj(const std::string& path, std::string_view text);
// PLY, ascii and binary of both endians: vertex, face, edge. Other elements are skipped, with a note; triangle
// strips are refused.
MeshFile read_ply(const std::string& path, std::string_view bytes);
// OFF, ascii and binary.
MeshFile read_off(const std::string& path, std::string_view bytes);
// STL, ascii and binary; each corner is a vertex of its own.
MeshFile read_stl(const std::string& path, std::string_view bytes);

}  // namespace app
