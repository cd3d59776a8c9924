// Proofs in doubles that a pair makes no contact, for tests that ask about millions of pairs: true only where
// it is so.
#pragma once

#include "tests/scenes/query.hpp"

namespace onset::oracle {

// Whether the pair certainly touches at no time in [0, until], and stays apart when every coordinate at
// `until` is then changed by at most `moved` >= 0, on the straight way there too.
bool surely_apart(const scenes::Query& query, double until = 1, double moved = 0);

// Whether the boxes of the whole motion are certainly farther apart than `gap` >= 0 on some axis.
bool boxes_apart(const scenes::Query& query, double gap);

}  // namespace onset::oracle
