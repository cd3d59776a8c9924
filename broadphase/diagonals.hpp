// The diagonals, eight directions beside the axes that may show two primitives to be apart.
#pragma once

#include "broadphase/broad_phase.hpp"
#include "scene/pair_sink.hpp"

namespace onset {

inline constexpr int kDiagonals = 8;
// Those of the faces of a cube, and two of its corners, which fill the lanes of a pack.
inline constexpr int kDiagonal[kDiagonals][3] = {{1, 1, 0}, {1, -1, 0}, {1, 0, 1}, {1, 0, -1},
                                                 {0, 1, 1}, {0, 1, -1}, {1, 1, 1}, {1, -1, 1}};

// Returns the most that a vector of length 1 reaches along a diagonal, rounded up.
double diagonal_reach(int diagonal, Norm norm);

// Says whether a diagonal separates two primitives on one side at both ends, by more than their inflations
// and input.diagonals.margin. They are then farther apart than that, in the norm, at every time in between
// (docs/theory.md, L52). This is the definition that all methods keep to. Adding a vector to the scene that
// changes no difference of coordinates does not change it.
// `which`: a bit for each diagonal that is looked at.
bool diagonals_apart(const BroadPhaseInput& input, PairKind kind, IdPair pair, unsigned which = 0xff);

}  // namespace onset
