// Proof that two primitives meet between two times, from boxes around their vertices.
#pragma once

#include <array>

#include "onset/result.hpp"

namespace onset {

struct VertexBox {
  std::array<double, 3> lo, hi;
};
// The four vertices of a pair, the first side before the second.
using PairBoxes = std::array<VertexBox, 4>;

// Says whether a pair is certain to have a common point at some time, given boxes that contain its vertices
// at the first time, at the last, and at all times in between, on any continuous paths: the pair's volume
// changes its sign, so that the four are in one plane at some time, and at all times the two, seen along one
// direction, lie across each other (docs/trajectories.md).
bool is_certain_to_cross(PairKind kind, const PairBoxes& first, const PairBoxes& last,
                         const PairBoxes& between);

}  // namespace onset
