// The rules of a scene, as its parts have them.
#pragma once

#include "mpi/scene/mesh_impl.hpp"

namespace onset::mpi {

// (c) Takes the rules of the scene and of this rank's slots out of a part. Throws std::invalid_argument where
// they are wrong, or not the same on all ranks.
void take_rules(const MeshPart& part, Mesh::Impl& mesh);

// Puts into the data of a part what `mesh.checked` has: rules that name bodies and planes.
void put_tables(const Mesh::Impl& mesh, MeshData& data);

}  // namespace onset::mpi
