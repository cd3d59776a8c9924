// Certificates for a whole interval of time when advancement crawls: features that nearly coincide and turn
// together.
#pragma once

#include "narrowphase/corners.hpp"

namespace onset {

// Returns the latest time until which the pair is certified from `t` on; `t` for none. Its distance is then
// more than wanted - 8 u rho (maximum norm: `wanted`, if that is 30 u rho or more). As delta/2 >= 58 u rho,
// it is beyond d for wanted = d + delta/2 (docs/theory.md, L19).
//
// A direction w(s) = m x e(s), m constant, is perpendicular to an edge however that turns, and sees the gap
// at full relative accuracy. w(s).c(s) = m.(e(s) x c(s)) is a quadratic, the same for corners that differ by
// e.
double certify_interval(const Corners& corners, double t, double wanted, bool maximum_norm);

}  // namespace onset
