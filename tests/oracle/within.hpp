// When a pair first comes within a distance, exactly.
#pragma once

#include "tests/oracle/oracle.hpp"

namespace onset::oracle {

// Whether the distance is at most d >= 0 at some t in [0, 1], and the first such t, as exact_ccd gives it (d
// = 0 asks exact_ccd).
Truth exact_within(const scenes::Query& query, double d, Norm norm = Norm::euclidean);

}  // namespace onset::oracle
