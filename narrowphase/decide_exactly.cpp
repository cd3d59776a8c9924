// The narrow phase asks exact arithmetic, or looks for a witness, whether a pair that is not certified free
// is a contact.
#include <algorithm>

#include "narrowphase/narrow_phase.hpp"

namespace onset {

bool NarrowPhase::uses_exact(const Case& c) const {
  return in_.options.exactness != Exactness::conservative && c.separation() == 0;
}
bool NarrowPhase::decides_completely(const Case& c) const {
  return uses_exact(c) && in_.options.exactness == Exactness::exact;
}

ExactPair NarrowPhase::exact_pair_of(const Case& c) const { return exact_pair(c.kind, in_.motion, c.vertices()); }

// unknown: not asked, or too dear. Contacts before `from` > 0 do not count. Within rounding of touching at the
// start, doubles cannot tell a contact soon after from parting: those are asked whatever the certainty.
ExactAnswer NarrowPhase::decide_exactly(const Case& c, const KernelResult& found, double from) const {
  if (found.verdict == Verdict::initial && from == 0 && c.separation() == 0) {
    const auto time = exact_first_contact(exact_pair_of(c));
    return time ? ExactAnswer{Answer::yes, *time} : ExactAnswer{Answer::no, {}};
  }
  if (!uses_exact(c)) return {Answer::unknown, {}};
  const bool complete = decides_completely(c);
  if (!complete && found.verdict == Verdict::max_checks)
    return {Answer::unknown, {}};  // as little as was asked for
  const ExactPair pair = exact_pair_of(c);
  if (from > 0) {
    if (!complete) return {Answer::unknown, {}};
    return {exactly_touches(pair, from) ? Answer::yes : Answer::no, {from, INFINITY}};
  }
  if (found.touched_by <= 1 && !in_.exact_times) return {Answer::yes, {found.t, found.touched_by}};
  if (complete && in_.exact_times) {
    const auto time = exact_first_contact(pair);
    return time ? ExactAnswer{Answer::yes, *time} : ExactAnswer{Answer::no, {}};
  }
  const ExactAnswer r = exact_answer(pair, complete ? Effort::complete : Effort::quick);
  // A start that is apart needs its own toi > 0.
  const bool wants_time = found.verdict != Verdict::contact;
  if (r.answer != Answer::yes || !wants_time || r.time.lo == r.time.hi) return r;
  return {Answer::yes, *exact_first_contact(pair)};
}

// Both primitives where they start.
bool NarrowPhase::touches_at_start(const Case& c) const {
  ExactPair pair = exact_pair_of(c);
  std::copy_n(pair.t0, 4, pair.t1);
  return exactly_touches(pair);
}

void NarrowPhase::sharpen(PairKind kind, PairResult& result) const {
  NarrowPhaseScratch scratch;
  const KernelPairs one = prepare(kind, &result.pair, 1, {}, scratch);
  const Case c{kind, result.pair, one, 0};
  if (!decides_completely(c)) return;
  const auto time = exact_first_contact(exact_pair_of(c));
  if (!time) return;
  if (result.outcome == PairOutcome::contact) result.toi = result.step_limit = time->lo;
  result.toi_hi = time->hi;
}

// Whether a point of each primitive is known, at a time from found.t on, that are no farther apart than the
// separation.
bool NarrowPhase::seen_within_separation(const Case& c, const KernelResult& found) const {
  if (in_.options.exactness != Exactness::exact) return false;
  const double d = c.input.separation[c.row] / found.unit;
  if (d == 0) return false;
  for (double ahead = 0x1p-20; ahead <= 1; ahead *= 4)
    if (distance_at(c, found.t + ahead * (1 - found.t)) <= d) return true;
  return false;
}

}  // namespace onset
