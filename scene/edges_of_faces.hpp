// The check that all edges of a mesh's faces are among its edges.
#pragma once

#include <array>
#include <vector>

namespace onset {

// Throws std::invalid_argument naming the first face with an edge that `edges` lacks, and that edge. All ids
// must be valid.
void require_edges_of_faces(const std::vector<std::array<int, 2>>& edges,
                            const std::vector<std::array<int, 3>>& faces);

}  // namespace onset
