// The searches in positions at rest, each within a budget.
#pragma once

#include "onset/close_pairs.hpp"
#include "onset/intersections.hpp"
#include "scene/pairs/rest_limits.hpp"
#include "src/shared/visit_pairs.hpp"
#include "src/start/rest.hpp"

namespace onset {

// Finds edges and faces with a common point, ordered by (edge, face). `rest` must hold Pairs::edge_face.
Gathered<Intersection> find_intersections(const Mesh& mesh, const Rest& rest, std::size_t most,
                                          Budget& budget);

// A pair that touches exactly, or is within its separation up to rounding.
struct NearPair {
  ClosePair pair;
  bool touches;
};
// Finds these among vertex-face and edge-edge pairs, ordered by (kind, a, b). `rest` must hold
// Pairs::within_separation.
Gathered<NearPair> find_near(const Mesh& mesh, const Rest& rest, const Options& options,
                             const RestLimits* limits, std::size_t most, Budget& budget);

}  // namespace onset
