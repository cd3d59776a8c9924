// Random queries that others are made from.
#pragma once

#include "tests/queries/query.hpp"
#include "tests/scenes/random.hpp"

namespace onset::scenes {

// Eight independent full-mantissa points in [-1, 1]^3: rarely a contact.
Query random_query(PairKind kind, Random& random);

// Moves the first primitive so that the two meet at about (t, u, v): F there is a few roundings, not exactly
// zero.
void aim(Query& query, double t, double u, double v);

// random_query aimed at an interior point of both primitives and an interior time.
Query interior_query(PairKind kind, Random& random);

// interior_query for one half of the seeds; for the other the first primitive is then shifted by 10^-3 .. 10,
// so that the answer may be anything. Unit size.
Query mixed_query(PairKind kind, Random& random);

// Eight points with integer coordinates in [-2^bits, 2^bits].
Query grid_query(PairKind kind, Random& random, int bits);

// A matrix of integers in [-3, 3]; a rotation, rounded; one of the 48 signed permutations.
Matrix integer_matrix(Random& random);
Matrix rotation(Random& random, double angle);
Matrix signed_permutation(Random& random);

}  // namespace onset::scenes
