// The arrays behind a Mesh.
#pragma once

#include <array>
#include <vector>

namespace onset {

struct MeshData {
  int num_vertices = 0;
  std::vector<std::array<int, 2>> edges;
  std::vector<std::array<int, 3>> faces;
  std::vector<double> thickness;  // empty: none; else one value >= 0 a vertex
};

}  // namespace onset
