// Counts of pairs by what leaves them out, made without a look at any pair.
#pragma once

#include <vector>

#include "scene/primitive_filter.hpp"

namespace onset {

// Fills the counts of pairs in filter.counts and, where the filter keeps any apart, marks in `idle` (by kind
// and id) the primitives that can meet nothing. Primitives alike are counted together, so that the time is
// linear in the mesh plus the square of the number of combinations of group and mask, of which at most 1,024
// are told apart.
void count_filtered(const MeshData& mesh, PrimitiveFilter& filter, std::array<std::vector<bool>, 3>& idle);

}  // namespace onset
