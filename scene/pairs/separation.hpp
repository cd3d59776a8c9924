// What a pair has to keep, by the rules of its mesh.
#pragma once

#include <cmath>
#include <limits>

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

// Returns a separation and the thickness of both sides, rounded up: two sums, for whose rounding the factor
// is more than enough. It grows with each of the three, rounded as it is, so that the largest of each bound
// all.
inline double with_thickness(double separation, double first, double second) {
  return (separation + first + second) * (1 + 0x1p-51);
}

// Returns the separation of a pair, model length, in the norm of the call, rounded up: the one of its bodies
// or of the call, plus thickness, but no more than the shape at rest allows, which is rounded down.
// `vertices`: of the first side, then of the second. rest: null where there is no such shape.
double separation_of_pair(const MeshData& mesh, const Options& options, const RestLimits* rest, PairKind kind,
                          IdPair pair, const int* vertices);

// What a vertex must keep from a plane: min_separation plus its thickness, rounded up to a double. The
// rounding error of the sum is a double, which is found exactly.
inline double separation_from_planes(const MeshData& mesh, const Options& options, int vertex) {
  if (mesh.thickness.empty()) return options.min_separation;
  const double a = options.min_separation, b = mesh.thickness[std::size_t(vertex)], sum = a + b;
  const double of_b = sum - a, error = (a - (sum - of_b)) + (b - of_b);
  return error > 0 ? std::nextafter(sum, std::numeric_limits<double>::infinity()) : sum;
}

}  // namespace onset
