// Free of contact, proved without any algebra: if the pair is d apart at t and no difference of its corners
// moves faster than v, it is apart until t + d / v.
#pragma once

#include "tests/oracle/oracle.hpp"

namespace onset::oracle {

// An upper bound of the Euclidean speed of any difference between a point of one primitive and a point of the
// other.
double relative_speed(const scenes::Query& query);

// An upper bound of the largest component of any such difference, at both ends: the size that relative
// tolerances refer to.
double extent(const scenes::Query& query);

struct Walk {
  double apart_until = 0;  // certainly farther apart than `gap` on [0, apart_until)
  bool finished = false;   // ... and at 1
};
Walk walk(const scenes::Query& query, double gap, double until, int steps, Norm norm = Norm::euclidean);

}  // namespace onset::oracle
