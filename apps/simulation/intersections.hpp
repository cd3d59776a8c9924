// Whether a mesh intersects itself, decided by exact predicates that know nothing of the library under test.
#pragma once

#include <array>
#include <onset/collision_rules.hpp>
#include <vector>

#include "simulation/system.hpp"

namespace simulation {

// Any two faces that meet anywhere but in a shared vertex or edge.
bool intersects_itself(const Vector& x, const std::vector<std::array<int, 3>>& faces);

// Any vertex that is not beyond a plane, in exact arithmetic.
bool is_behind_a_plane(const Vector& x, const std::vector<onset::Plane>& planes);

}  // namespace simulation
