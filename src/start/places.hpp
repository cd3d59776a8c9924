// The places that more than one vertex is at.
#pragma once

#include <vector>

#include "onset/views.hpp"

namespace onset {

// Returns the vertices of each such place, ascending, and the places by their first vertex. x is #V x 3 and
// finite.
std::vector<std::vector<int>> shared_places(const Positions& x);

}  // namespace onset
