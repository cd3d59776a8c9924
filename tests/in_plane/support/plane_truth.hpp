// When a vertex and an edge in the plane first touch: exact, in rational numbers.
#pragma once

#include <onset/query.hpp>

namespace onset::tests {

struct PlaneTruth {
  bool collides = false;
  // The first contact is between these adjacent doubles, or at both.
  double lo = 0, hi = 0;
  bool at_start() const { return collides && hi == 0; }
};
PlaneTruth plane_truth(const VertexEdgeQuery& query);

// Whether stored points touch.
bool touch(const PlanePoint& p, const PlanePoint& a, const PlanePoint& b);

// Whether two closed edges have a common point.
bool edges_meet(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c, const PlanePoint& d);

}  // namespace onset::tests
