// The planes of a mesh, made ready for every call: scaled, and with the vertices that meet each.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "scene/mesh_data.hpp"

namespace onset {

// n.x - offset times 2^-exponent is scaled.x - scaled_offset, but for what underflows: the largest component
// of `scaled` is in [1, 2). An offset that is too large for that is infinite.
struct MeshPlane {
  std::array<double, 3> normal{}, scaled{};
  double offset = 0, scaled_offset = 0;
  int exponent = 0;
  // Upper bounds: the magnitude of each component of `scaled` as it is in exact arithmetic, its length, and
  // the sum of its magnitudes.
  std::array<double, 3> magnitude{};
  double length = 0, sum = 0;
  // The vertices that meet it, ascending; where all do, `all`, and the list is empty.
  std::vector<int> vertices;
  bool all = true;
};

struct MeshPlanes {
  std::vector<MeshPlane> rows;
};

// Says whether the rules let a vertex meet a plane, by row.
bool may_meet_plane(const MeshData& mesh, int vertex, int plane);

// Returns null where the mesh has no planes.
std::shared_ptr<const MeshPlanes> make_planes(const MeshData& mesh);

}  // namespace onset
