// Vertices and planes where they stand.
#pragma once

#include <array>

#include "src/planes/plane_blocks.hpp"
#include "src/start/rest_pairs.hpp"

namespace onset {

// Finds {vertex, plane} of the vertices on a plane or behind it, exactly, ordered by both. The motion must be
// usable; so for the next.
Gathered<std::array<int, 2>> find_behind_planes(const Mesh& mesh, const Motion& motion,
                                                const Options& options, std::size_t most, Budget& budget);

// Appends these too, and the vertices that are no farther from a plane than their separation, exactly, in the
// norm asked for: at most `most`, with what is there already.
void add_near_planes(const Mesh& mesh, const Motion& motion, const Options& options, std::size_t most,
                     Budget& budget, Gathered<NearPair>& all);

}  // namespace onset
