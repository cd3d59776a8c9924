// Whether a mesh intersects itself, decided by exact predicates that know nothing of the library under test.
#pragma once

#include <array>
#include <onset/collision_rules.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "simulation/system.hpp"

namespace simulation {

// The first two faces that meet anywhere but in a shared vertex or edge.
std::optional<std::pair<int, int>> faces_that_meet(const Vector& x,
                                                   const std::vector<std::array<int, 3>>& faces);

// The first vertex that is not beyond a plane, in exact arithmetic, and that plane.
std::optional<std::pair<int, int>> vertex_behind_plane(const Vector& x,
                                                       const std::vector<onset::Plane>& planes);

// Either, in words; empty where there is none.
std::string intersection_in_words(const Vector& x, const std::vector<std::array<int, 3>>& faces,
                                  const std::vector<onset::Plane>& planes);

}  // namespace simulation
