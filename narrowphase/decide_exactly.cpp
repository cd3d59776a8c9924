// Whether a pair that is not certified free is a contact, by exact arithmetic or a witness.
#include <algorithm>

#include "narrowphase/pair_decision.hpp"

namespace onset {

bool PairDecision::uses_exact() const {
  return in_.options.exactness != Exactness::conservative && separation() == 0;
}
bool PairDecision::decides_completely() const {
  return uses_exact() && in_.options.exactness == Exactness::exact;
}

ExactPair PairDecision::exact_pair_of_this() const { return exact_pair(kind_, in_.motion, vertices()); }

// Returns `unknown` where integers are not asked or too dear. Contacts before `from` > 0 do not count. Near
// touching at the start doubles cannot tell a contact soon after from parting: there they are always asked.
ExactAnswer PairDecision::decide_exactly(const KernelResult& found, double from) const {
  if (found.verdict == Verdict::initial && from == 0 && separation() == 0) {
    const auto time = exact_first_contact(exact_pair_of_this());
    return time ? ExactAnswer{Answer::yes, *time} : ExactAnswer{Answer::no, {}};
  }
  if (!uses_exact()) return {Answer::unknown, {}};
  const bool complete = decides_completely();
  if (!complete && found.verdict == Verdict::max_checks)
    return {Answer::unknown, {}};  // as little as was asked for
  const ExactPair pair = exact_pair_of_this();
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

bool PairDecision::touches_at_start() const {
  ExactPair pair = exact_pair_of_this();
  std::copy_n(pair.t0, 4, pair.t1);
  return exactly_touches(pair);
}

void PairDecision::sharpen(PairResult& result) const {
  if (!decides_completely()) return;
  const auto time = exact_first_contact(exact_pair_of_this());
  if (!time) return;
  result.toi_hi = time->hi;
  if (result.outcome != PairOutcome::contact) return;
  if (time->lo > result.toi) result.tolerance = distance_before_touching(*time) * corners().unit;
  result.toi = result.step_limit = time->lo;
}

// Corners move by at most 2 rho in the whole step, which bounds the distance of a pair that touches by
// time.hi.
double PairDecision::distance_before_touching(const DoubleBracket& time) const {
  return std::min(distance_at(time.lo), 2 * corners().rho * (time.hi - time.lo) * (1 + 0x1p-40) + 0x1p-1074);
}

// Tells whether a look from found.t on shows points within the separation.
bool PairDecision::seen_within_separation(const KernelResult& found) const {
  if (in_.options.exactness != Exactness::exact) return false;
  const double d = pairs_.separation[row_] / found.unit;
  if (d == 0) return false;
  for (double ahead = 0x1p-20; ahead <= 1; ahead *= 4)
    if (distance_at(found.t + ahead * (1 - found.t)) <= d) return true;
  return false;
}

}  // namespace onset
