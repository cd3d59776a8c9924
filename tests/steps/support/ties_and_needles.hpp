// Pairs whose closest features are hard to tell, and separations next to their distance.
#pragma once

#include "tests/queries/query.hpp"
#include "tests/scenes/random.hpp"

namespace onset::tests {

// The foot of the vertex ties with a corner or a side within 1e-16 .. 1e-6; ends of edges likewise, and edges
// that are nearly parallel; some of the faces and edges are needles of 1e2 to 1e12. The motion presses,
// parts, slides or does all at once, by a thousandth to a hundred times the distance.
scenes::Query tie_or_needle(PairKind kind, scenes::Random& random);

// Next to the distance at the start, by 1e-16 .. 1e-1 of it on either side.
double separation_near(double distance, scenes::Random& random);

}  // namespace onset::tests
