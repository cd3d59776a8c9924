// How close a pair comes, for tests of minimum separations.
#pragma once

#include "tests/oracle/promises.hpp"
#include "tests/queries/query.hpp"

namespace onset::tests {

// The distance in double arithmetic.
double rough_distance(const scenes::Query& query, double t, Norm norm);

// A time at which the pair is nearly closest.
double rough_closest_time(const scenes::Query& query, Norm norm);

// Whether the pair comes closer than d > 0, and a time at which it does (exactly; hardly later than the first
// such). A dip between the samples may be overlooked.
oracle::Known known_within(const scenes::Query& query, double d, Norm norm);

// Empty, or the promise that the answer breaks. Minimum separations are sampled, d = 0 is exact.
std::string broken_promise(const scenes::Query& query, const Options& options, const QueryResult& result);

}  // namespace onset::tests
