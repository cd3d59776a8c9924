// The first contact of primitives that are coplanar at every time, in integers of fixed width.
#pragma once

#include "narrowphase/exact/pair.hpp"
#include "narrowphase/exact/root.hpp"

namespace onset {

struct CoplanarContact {
  Answer answer = Answer::no;
  DoubleBracket time;  // yes: it holds the first contact
};

// Given q.(a x b) = 0 for all t, as it is in the plane, no contact at t = 0, and coordinates of q, a, b below
// 2^62: the time is between adjacent doubles if `adjacent`, else within 2^-29 of itself. unknown: it is so
// early that its double does not fit.
CoplanarContact first_coplanar_contact(PairKind kind, const RelativeVectors<std::int64_t>& r0,
                                       const RelativeVectors<std::int64_t>& r1, bool adjacent);
// The same for coordinates below 2^121.
CoplanarContact first_coplanar_contact(PairKind kind, const RelativeVectors<Wide<2>>& r0,
                                       const RelativeVectors<Wide<2>>& r1, bool adjacent);

}  // namespace onset
