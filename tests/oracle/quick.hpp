// Answers in doubles where these are certain, for tests that ask about millions of pairs.
#pragma once

#include "tests/queries/query.hpp"

namespace onset::oracle {

// Whether the pair certainly touches at no time in [0, until], and stays apart when every coordinate at
// `until` is then changed by at most `moved` >= 0, on the straight way there too.
bool surely_apart(const scenes::Query& query, double until = 1, double moved = 0);

// Whether the boxes of the whole motion are certainly farther apart than `gap` >= 0 on some axis.
bool boxes_apart(const scenes::Query& query, double gap);

// The side of the face's plane, or of the plane of both edges, that the first primitive is on: the exact sign
// of det(q, a, b); 0 where the four points are coplanar.
int orientation(PairKind kind, const std::array<Point, 4>& x);

}  // namespace onset::oracle
