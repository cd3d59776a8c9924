// What the parts of a pair's decision share.
#pragma once

#include "narrowphase/narrow_phase.hpp"
#include "narrowphase/vec.hpp"

namespace onset {

// Advancement converges so fast that stopping at a sixteenth of the tolerance costs about one check, and most
// pairs that pass within the tolerance without touching are then told apart.
constexpr double kSharpness = 0.0625;
// Nor is more given away than this share of the pair's size: hand-made near misses have gaps of 1e-11 of it.
constexpr double kSharpest = 0x1p-38;

// 16 E7, of rho: advancement tells no less.
constexpr double kLeastTolerance = 116 * 0x1p-53;

// Of rho: a certificate of a start sees no smaller gap.
constexpr double kStartNoise = 16 * 0x1p-53;

// A pair's distance at one time, scaled as its corners are: between `lower` and `upper`; w: a direction of length 1 along
// which every corner is beyond about `lower`.
struct NarrowPhase::Bounds {
  double lower, upper;
  Vec w;
};

}  // namespace onset
