// The decision that covers every degenerate pair, in integers of any size.
#pragma once

#include <optional>

#include "narrowphase/exact/pair.hpp"
#include "narrowphase/exact/root.hpp"

namespace onset {

// Whether the two touch at a time in [from, 1], from in [0, 1]. 20 us to some ms.
bool completely_touches(const ExactPair& pair, double from);
// The first contact in [0, 1]; adjacent: between adjacent doubles, else in an interval as wide as it comes.
std::optional<DoubleBracket> complete_first_contact(const ExactPair& pair, bool adjacent = true);

// The sign of f = q.(a x b) just before t, in (0, 1], or at t where it is not 0 there (at t = 0 it is that);
// 0 where f is 0 for all times.
int side_before(const ExactPair& pair, double t);

}  // namespace onset
