// Certificates for a whole interval of time when advancement crawls: features that nearly coincide and turn
// together.
#pragma once

#include "narrowphase/corners.hpp"

namespace onset {

// The latest time certified from `t` on: the pair is farther apart than `wanted` (scaled as the corners) on
// [t, result]. Equal to t when nothing is certified. Tries [t, 1] and shorter intervals.
//
// A direction that stays perpendicular to an edge through the interval, w(s) = m x e(s) with m constant, sees
// the gap at full relative accuracy however the edge turns. w(s).c(s) = m.(e(s) x c(s)), a quadratic in s,
// the same for the two corners that differ by e: two vector quadratics in all.
double certify_interval(const Corners& corners, double t, double wanted, bool maximum_norm);

}  // namespace onset
