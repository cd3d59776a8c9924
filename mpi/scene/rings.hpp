// Neighbours on a mesh whose edges lie on several ranks (CollisionRules::excluded_rings).
#pragma once

#include "mpi/scene/mesh_impl.hpp"

namespace onset::mpi {

// (c) Fills mesh.near. Throws std::invalid_argument where the scene has more pairs of vertices that near than
// VertexRings::kMostPairs.
void find_rings(const VertexOwners& owners, int rings, Mesh::Impl& mesh);

}  // namespace onset::mpi
