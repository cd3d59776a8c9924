// What the calls on positions at rest look for, within one budget.
#pragma once

#include "onset/close_pairs.hpp"
#include "onset/intersections.hpp"
#include "src/shared/visit_pairs.hpp"
#include "src/start/rest.hpp"

namespace onset {

// Edges and faces with a common point, ordered by (edge, face); `rest` was asked to find Pairs::edge_face.
Gathered<Intersection> find_intersections(const Mesh& mesh, const Rest& rest, std::size_t most,
                                          Budget& budget);

// Vertex-face and edge-edge pairs that touch (distance and gap 0), or are within their separation, or beyond
// it by no more than rounding, ordered by (kind, a, b); `rest` was asked to find Pairs::within_separation.
struct NearPair {
  ClosePair pair;
  bool touches;
};
Gathered<NearPair> find_near(const Mesh& mesh, const Rest& rest, const Options& options, std::size_t most,
                             Budget& budget);

}  // namespace onset
