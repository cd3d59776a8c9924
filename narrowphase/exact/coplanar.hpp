// Two primitives that are coplanar at every time: their first contact, in integers of fixed width.
#pragma once

#include "narrowphase/exact/pair.hpp"
#include "narrowphase/exact/root.hpp"

namespace onset {

struct CoplanarContact {
  Answer answer = Answer::no;
  DoubleBracket time;  // yes: an interval that holds the first contact
};

// Given q.(a x b) = 0 for all t and no contact at t = 0; adjacent: between adjacent doubles, or the double
// that it is, else within 2^-29 of its time. unknown: so early that a double there does not fit.
// Coordinates of q, a, b below 2^62.
CoplanarContact first_coplanar_contact(PairKind kind, const RelativeVectors<std::int64_t>& r0,
                                       const RelativeVectors<std::int64_t>& r1, bool adjacent);
// Below 2^121.
CoplanarContact first_coplanar_contact(PairKind kind, const RelativeVectors<Wide<2>>& r0,
                                       const RelativeVectors<Wide<2>>& r1, bool adjacent);

}  // namespace onset
