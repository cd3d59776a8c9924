// The truth about single queries: exact rational arithmetic, no tolerance, every degenerate case. Coordinates
// must be finite; 0.1 to 2 ms a query.
#pragma once

#include <onset/query.hpp>

#include "tests/oracle/arithmetic/root.hpp"
#include "tests/queries/query.hpp"

namespace onset::oracle {

// Whether the closed primitives touch at some t in [0, 1]. If so, the first such t lies between the adjacent
// doubles toi_lo and toi_hi, or is the double toi_lo == toi_hi. If not, both are infinite.
struct Truth {
  bool collides = false;
  double toi_lo = INFINITY, toi_hi = INFINITY;
};
Truth exact_ccd(const scenes::Query& query);
Truth exact_ccd(const VertexFaceQuery& query);
Truth exact_ccd(const EdgeEdgeQuery& query);

// The first contact at t > 0, where contacts are isolated; collides is false for pairs that stay coplanar for
// all t.
Truth exact_ccd_after_start(const scenes::Query& query);

// The sign of (distance at time t) - d, exactly. t and d are any finite doubles, d >= 0.
int compare_distance(const scenes::Query& query, double t, double d, Norm norm = Norm::euclidean);
inline bool closer_than(const scenes::Query& query, double t, double d, Norm norm = Norm::euclidean) {
  return compare_distance(query, t, d, norm) < 0;
}

// The distance at time t, and the squared Euclidean one, rounded down and up. Must be below the largest
// double.
Bracket distance(const scenes::Query& query, double t, Norm norm = Norm::euclidean);
Bracket distance2(const scenes::Query& query, double t);

}  // namespace onset::oracle
