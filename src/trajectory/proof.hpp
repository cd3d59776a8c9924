// Whether a contact of what turns is a real one, and by when.
#pragma once

#include <vector>

#include "onset/result.hpp"
#include "src/trajectory/pieces.hpp"

namespace onset {

// Looks for a time by which the pair has met, from its toi on, as far as the tries go, and makes the contact
// certain where there is one. thickness: of each vertex, or empty.
void prove(Pieces& pieces, const std::vector<double>& thickness, double min_separation, Contact& contact);

}  // namespace onset
