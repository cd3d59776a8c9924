// Two primitives that are coplanar at every time: their first contact, in integers of fixed width.
#pragma once

#include <optional>

#include "narrowphase/exact_pair.hpp"
#include "narrowphase/exact_root.hpp"

namespace onset {

struct CoplanarContact {
  Answer answer = Answer::no;
  DoubleBracket time;  // yes: an interval that holds the first contact
};

// adjacent: between adjacent doubles, or the double that it is; else in 2^-29 of its time.
// Given q.(a x b) = 0 for all t and no contact at t = 0. Coordinates of q, a, b below 2^62. unknown: the
// first contact is so early that a double there does not fit.
CoplanarContact first_coplanar_contact(PairKind kind, const RelativeVectors<std::int64_t>& r0,
                                       const RelativeVectors<std::int64_t>& r1, bool adjacent);

}  // namespace onset
