// Pairs at rest whose closest points are hard to tell: features that tie, primitives that are thin or have no
// extent.
#pragma once

#include <array>

#include "tests/queries/query.hpp"
#include "tests/scenes/random.hpp"

namespace onset::tests {

using PairPoints = std::array<Point, 4>;  // as in Query

// A point above a corner or a side that two features share, off it by next to nothing, at any height.
PairPoints tie(PairKind kind, scenes::Random& random);
// Thinner than anything that is left of a cross product, the other primitive near it.
PairPoints needle(PairKind kind, scenes::Random& random);
// Edges at angles from 0 to 1e-6, on one line, side by side, or one above the other; faces with next to no
// area.
PairPoints parallel(PairKind kind, scenes::Random& random);
// Edges of no length, faces without area, all at one point.
PairPoints degenerate(PairKind kind, scenes::Random& random);
// Small integers: exact ties, touching and coplanar pairs of every kind.
PairPoints lattice(PairKind kind, scenes::Random& random);
// One near the other by anything from a unit to 1e-300.
PairPoints near_touching(PairKind kind, scenes::Random& random);
// In any position that keeps ties exact, and now and then in others and far away, at any scale.
PairPoints placed(PairPoints x, scenes::Random& random);

}  // namespace onset::tests
