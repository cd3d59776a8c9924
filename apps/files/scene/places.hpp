// Vertices at exactly the same place.
#pragma once

#include <array>
#include <vector>

#include "files/mesh/mesh_file.hpp"

namespace app {

// For each row the first row that is the same; -0 and 0 are.
std::vector<Eigen::Index> first_at_place(const Points& x);

// {first vertex at a place, another one there}, by both, of those that are together in both frames.
std::vector<std::array<int, 2>> copies_together(const Points& x_t0, const Points& x_t1);

}  // namespace app
