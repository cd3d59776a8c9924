// The decision that covers every degenerate pair, in integers of any size.
#pragma once

#include <optional>

#include "narrowphase/exact/pair.hpp"
#include "narrowphase/exact/root.hpp"

namespace onset {

// Tells whether the two touch at a time in [from, 1], from in [0, 1]. 20 us to some ms.
bool completely_touches(const ExactPair& pair, double from);
// Finds the first contact in [0, 1], between adjacent doubles if `adjacent`, else in a wider interval.
std::optional<DoubleBracket> complete_first_contact(const ExactPair& pair, bool adjacent = true);

// Returns the sign of f = q.(a x b), in the plane of f = a x q, at t, or just before t > 0 where it is 0
// there; 0 where f is 0 for all times.
int side_before(const ExactPair& pair, double t);

}  // namespace onset
