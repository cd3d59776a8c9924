// The diagonals, six directions beside the axes that may show two primitives to be apart.
#pragma once

#include "broadphase/broad_phase.hpp"
#include "scene/pair_sink.hpp"

namespace onset {

// Those of the faces of a cube, which flips and exchanges of axes turn into one another, two of them twice,
// as a pack has eight lanes. Two of the four corners of a cube would flip into the others.
inline constexpr int kDiagonals = 8;
inline constexpr int kDiagonal[kDiagonals][3] = {{1, 1, 0}, {1, -1, 0}, {1, 0, 1}, {1, 0, -1},
                                                 {0, 1, 1}, {0, 1, -1}, {1, 1, 0}, {1, -1, 0}};

// Returns the most that a vector of length 1 reaches along a diagonal, rounded up.
double diagonal_reach(Norm norm);

// Says whether a diagonal separates two primitives on one side at both ends, by more than their inflations
// and input.diagonals.margin. They are then farther apart than that, in the norm, at every time in between
// (docs/theory.md, L52). This is the definition that all methods keep to. Adding a vector to the scene that
// changes no difference of coordinates does not change it.
// `which`: a bit for each diagonal that is looked at.
bool diagonals_apart(const BroadPhaseInput& input, PairKind kind, IdPair pair, unsigned which = 0xff);

}  // namespace onset
