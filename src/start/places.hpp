// The places that more than one vertex is at.
#pragma once

#include <vector>

#include "base/stop.hpp"
#include "onset/views.hpp"

namespace onset {

// Returns the vertices of each such place, ascending, and the places by their first vertex. x is #V x 3 and
// finite. None where it was stopped.
std::vector<std::vector<int>> shared_places(const Positions& x, const Stop& stop = {});

}  // namespace onset
