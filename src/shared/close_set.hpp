// The candidates that are within d-hat at given positions.
#pragma once

#include <array>

#include "onset/close_pairs.hpp"
#include "onset/export.hpp"
#include "scene/pair_source.hpp"
#include "scene/pairs/separation.hpp"
#include "src/shared/visit_pairs.hpp"

namespace onset {

// Throws std::invalid_argument unless d_hat is > 0 (or 0 where allowed) and at most 2^1020.
ONSET_API void check_d_hat(double d_hat, bool zero_allowed);

// Returns a length of the model, rounded up. A distance set of `d_hat` holds only pairs that come closer than
// this plus their thickness, or less, in exact motion, where storing positions changes distances by at most
// `rounding`.
double euclidean_reach(const MeshData& mesh, const Options& options, double d_hat, double rounding);

// Returns the Euclidean separation of a pair, rounded up; exact where there is nothing to add. rest: what the
// shape at rest leaves of separations; null: all.
double euclidean_separation(const Mesh& mesh, const Options& options, const RestLimits* rest,
                            const Pair& pair);

// A pair of a vertex and a plane with its separation.
ClosePair pair_with_plane(const Mesh& mesh, const Options& options, int vertex, int plane);
// Puts its distance, right to 2^-49 of itself, and what is certainly its gap; returns that before it is
// rounded down, which may be below 0.
double put_plane_distance(double distance, ClosePair& pair);

struct CloseInput {
  const Mesh& mesh;
  // 4 doubles a vertex: x y z and one unused, in any order of axes.
  const double* x;
  double d_hat;
  // Pairs beyond d_hat by up to this are listed as well.
  double slack;
  const Options& options;
  // Of x: Motion::axes.
  std::array<int, 3> axes;
  // What the shape at rest leaves of separations; null: all.
  const RestLimits* rest = nullptr;
};

// Adds the pair where its exact distance may be below d_hat plus its separation.
void add_if_close(const CloseInput& input, PairKind kind, IdPair ids, std::vector<ClosePair>& close);

// Sorted by (kind, a, b); none where the budget is spent, or memory_limit.
Gathered<ClosePair> find_close(const PairSource& candidates, const CloseInput& input, Budget& budget);

}  // namespace onset
