// Counts pairs by what leaves them out, without looking at any pair: primitives alike are counted together.
#pragma once

#include <vector>

#include "scene/primitive_filter.hpp"

namespace onset {

// Fills the counts of pairs in filter.counts and, where the filter keeps any apart, marks in `idle` (by Primitive,
// by id) the primitives that can meet nothing. Time:
// linear in the mesh, plus the square of the number of different combinations of group and mask (at most
// 1,024 are told apart).
void count_filtered(const MeshData& mesh, PrimitiveFilter& filter, std::array<std::vector<bool>, 3>& idle);

}  // namespace onset
