// Vertices that are at one place.
#pragma once

#include <vector>

#include "onset/views.hpp"

namespace onset {

// The vertices of each place that more than one is at, ascending; places by their first vertex. x is finite,
// #V x 3.
std::vector<std::vector<int>> shared_places(const Positions& x);

}  // namespace onset
