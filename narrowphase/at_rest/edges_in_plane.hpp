// What two closed edges at rest in the plane have in common: exact, for the stored doubles.
#pragma once

#include <array>

#include "narrowphase/at_rest/edge_face.hpp"

namespace onset {

// Points have three finite coordinates, the third 0, of any magnitude. Edges of length zero are the points
// that they are. An answer takes 10 ns where rounding leaves no doubt, else some microseconds.
EdgeFace edges_in_plane(const std::array<const double*, 2>& e, const std::array<const double*, 2>& f);

}  // namespace onset
