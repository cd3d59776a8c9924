// Certificates for an interval of time, for features that nearly coincide and turn together.
#pragma once

#include "narrowphase/corners.hpp"

namespace onset {

// Returns the latest time until which the pair is certified from `t` on, at a distance of more than wanted -
// 8 u rho (maximum norm: `wanted`, if that is 30 u rho or more); `t` for none. For wanted = d + delta/2 it is
// beyond d, since delta/2 >= 58 u rho (docs/theory.md, L19).
//
// A direction w(s) = m x e(s), m constant, stays perpendicular to an edge e, so it sees the gap at full
// relative accuracy; w(s).c(s) = m.(e(s) x c(s)) is the same for corners that differ by e.
double certify_interval(const Corners& corners, double t, double wanted, bool maximum_norm);

}  // namespace onset
