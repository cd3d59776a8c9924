// Random queries of a vertex and an edge, most of them degenerate in some way.
#pragma once

#include <onset/query.hpp>

#include "tests/scenes/random.hpp"

namespace onset::tests {

enum class PlaneFamily {
  uniform,
  grid,        // small integers: ties, collinear points, touching starts
  aimed,       // the vertex comes to a point of the edge, or an ulp beside it
  at_end,      // the same at an end of the edge
  grazing,     // the vertex touches the turning edge and comes back, or misses it by an ulp
  on_a_line,   // all moves along one line
  point_edge,  // an edge of length zero
  huge_and_tiny,
};
inline constexpr int kPlaneFamilies = 8;

VertexEdgeQuery plane_query(PlaneFamily family, scenes::Random& random);

}  // namespace onset::tests
