// Tetrahedra out of Gmsh's files.
#pragma once

#include <string>

#include "elastic/meshes/meshing.hpp"

namespace elastic {

// MSH 2.2 or 4.1, ascii; elements other than tetrahedra of four nodes are passed over, and so are nodes of no
// tetrahedron. Throws app::InputError naming the path, the line and the cause.
TetMesh read_msh(const std::string& path);

}  // namespace elastic
