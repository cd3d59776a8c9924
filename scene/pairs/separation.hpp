// What a pair has to keep, by the rules of its mesh.
#pragma once

#include "onset/options.hpp"
#include "scene/mesh_data.hpp"
#include "scene/pairs/rest_limits.hpp"

namespace onset {

// Says whether rules beyond thickness give pairs separations of their own.
inline bool has_pair_separations(const MeshData& mesh) {
  return !mesh.body_separations.empty() || mesh.rest != nullptr;
}

// Says whether any vertex has a thickness, here or elsewhere in the scene that this mesh is a part of.
inline bool has_thickness(const MeshData& mesh) {
  return !mesh.thickness.empty() || mesh.thickest_elsewhere > 0;
}

// Returns the largest separation that a call may ask of a pair, thickness apart.
double largest_of_bodies(const MeshData& mesh, const Options& options);

// Returns the separation of a pair, model length, in the norm of the call, rounded up: the one of its bodies
// or of the call, plus thickness, but no more than the shape at rest allows, which is rounded down.
// `vertices`: of the first side, then of the second. rest: null where there is no such shape.
double separation_of_pair(const MeshData& mesh, const Options& options, const RestLimits* rest, PairKind kind,
                          IdPair pair, const int* vertices);

}  // namespace onset
