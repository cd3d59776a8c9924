// How far a pair lets a step go whose end is stored in doubles (docs/theory.md, §18).
//
// Storing changes a distance by at most a bound R of the pair's coordinates, so a step may end where the pair
// is beyond d + R, after an exact motion beyond d. With room for that a pair limits the step by a time; else
// the step may only end at 0, or from when R is cleared.
#include <algorithm>
#include <cmath>

#include "base/assert.hpp"
#include "narrowphase/pair_decision.hpp"
#include "scene/motion/motion.hpp"
#include "scene/motion/storing.hpp"

namespace onset {

struct PairDecision::StoredLimit {
  // A step may end at 0 or in [from, found.t], or anywhere from `from` on where the verdict is free.
  double from = 0;
  KernelResult found{};
};

double PairDecision::storing_rounding() const {
  double largest = 0;
  for (const int v : vertices())
    for (int a = 0; a < 3; ++a)
      largest = std::max({largest, std::fabs(in_.motion.t0(v)[a]), std::fabs(in_.motion.t1(v)[a])});
  return (pairs_.storing * largest + kStoredLeast) / corners().unit * (1 + 0x1p-50);
}

std::optional<PairResult> PairDecision::from_scratch() {
  KernelPairs one = pairs_;
  one.vertices += row_, one.separation += row_, one.count = 1;
  if (int survivor = 0; !in_.inclusion_only() && kernels_.cull(one, &survivor) == 0) return std::nullopt;
  KernelResult r;
  advance(nullptr, r);
  if (r.verdict == Verdict::free) return std::nullopt;
  if (in_.options.exactness != Exactness::conservative) kernels_.certify(pairs_, &row_, 1, &r);
  if (in_.inclusion_only()) r.checks = 0;
  stats_.checks += r.checks;
  return contact(r);
}

// Finds the contact of the exact motion as an active set does, whatever t_max is.
std::optional<PairResult> PairDecision::exact_motion() {
  if (in_.contacts != nullptr && !in_.contacts->holds(in_.contacts->context, kind_, pair_))
    return std::nullopt;
  const KernelPairs plain = without_storing(pairs_, 1);
  return of(plain).from_scratch();
}

void PairDecision::note_kept(double share) {
  if (share >= in_.gap_share * (1 - 0x1p-20)) return;
  NarrowPhaseStats here;
  here.least_share = share;
  here.closest = pair_;
  stats_.add(here);
}

std::optional<PairResult> PairDecision::stored_step(const KernelResult& checked) {
  std::optional<PairResult> contact;  // of the exact motion
  StoredLimit limit{0, checked};
  bool searched = false;
  if (checked.verdict == Verdict::initial) {
    if (is_welded()) return std::nullopt;
    limit = limit_from_start(contact);
  } else {
    limit.found = carry_on(checked, searched);
    contact = exact_motion();
  }
  KernelResult& found = limit.found;
  // Without a contact, or with its exact time, and with no share to keep, rounding alone limits the step.
  const bool sharper = in_.gap_share == 0 && (!contact || in_.times_are_exact());
  if (sharper && found.verdict == Verdict::contact && found.t > 0) {
    found.delta = kLeastTolerance * corners().rho;
    found.verdict = found.checks < pairs_.max_checks ? Verdict::stalled : Verdict::max_checks;
    found = carry_on(found, searched);
  }
  const bool free = found.verdict == Verdict::free;
  if (free && limit.from == 0 && !contact) return std::nullopt;
  // A share that would be lost is a contact with what is kept.
  const bool spent = found.verdict == Verdict::max_checks && found.t > 0 && found.checks >= pairs_.max_checks;
  const PairOutcome outcome = spent                              ? PairOutcome::max_checks
                              : in_.gap_share > 0 && found.t > 0 ? PairOutcome::contact
                                                                 : PairOutcome::below_rounding;
  PairResult r{pair_, INFINITY, INFINITY, 0, outcome};
  if (contact)
    r = *contact;
  else if (!free)
    r.tolerance = std::max(0.0, (distance_at(found.t) - separation() / found.unit) * found.unit);
  r.stored_limit = std::min(free ? INFINITY : found.t, r.step_limit);
  r.clear_from = limit.from;
  ONSET_ASSERT(r.stored_limit >= 0 && r.clear_from >= 0);
  return r;
}

KernelResult PairDecision::limit_from(const Bounds& at, double t, double kept) {
  const KernelResult found = advance_from(at, t, kept);
  stats_.checks += found.checks;
  bool searched = false;
  return carry_on(found, searched);
}

// Returns the first of some times at which the pair is beyond `wanted`; infinite for none.
double PairDecision::clear_time(double wanted) const {
  for (double t = 0x1p-52; t <= 1; t *= 16)
    if (bounds_at(t).lower > wanted) return t;
  return INFINITY;
}

PairDecision::StoredLimit PairDecision::limit_from_start(std::optional<PairResult>& contact) {
  const Bounds start = bounds_at(0);
  const double d = separation() / corners().unit, rounding = storing_rounding(), gap = start.upper - d;
  const double apart = start.lower - d, wanted = in_.gap_share * gap + kStoredRoundings * rounding;
  const double kept =
      std::min({wanted, 0.5 * (1 + in_.gap_share) * apart, apart - 2 * kStartNoise * corners().rho});
  if (kept > rounding) {
    note_kept((kept - rounding) / gap);
    const StoredLimit limit{0, limit_from(start, 0, kept)};
    contact = exact_motion();
    return limit;
  }
  contact = exact_motion();
  const PairOutcome outcome = contact ? contact->outcome : PairOutcome::free;
  KernelResult blocked{};
  blocked.unit = corners().unit, blocked.verdict = Verdict::max_checks;
  if (outcome == PairOutcome::initial_contact) return {0, blocked};
  if (rests(exact_pair_of_this())) {  // nothing is rounded
    blocked.verdict = Verdict::free;
    return {0, blocked};
  }
  if (outcome == PairOutcome::initial_separating) return limit_after_parting(start);
  return limit_of_small_gap(contact);
}

// Limits a pair that is beyond d at the start by less than storing can close: the step may end where it is
// clear of that.
PairDecision::StoredLimit PairDecision::limit_of_small_gap(const std::optional<PairResult>& contact) {
  const double d = separation() / corners().unit, kept = storing_rounding() * (1 + 0x1p-20);
  const double clear = clear_time(d + kept + 2 * kStartNoise * corners().rho);
  note_kept(0);
  if (clear > 1 || (contact && clear >= contact->toi)) {
    StoredLimit blocked{};
    blocked.found.unit = corners().unit, blocked.found.verdict = Verdict::max_checks;
    return blocked;
  }
  return {clear, limit_from(bounds_at(clear), clear, kept)};
}

// Limits a pair that is within d at the start and parts; its distance does not fall but for noise
// (docs/theory.md, (17.1)). Stored, it must not touch: where that is close, the step may end once the pair is
// clear, and certified so until it has parted.
PairDecision::StoredLimit PairDecision::limit_after_parting(const Bounds& start) {
  const double rounding = storing_rounding() * (1 + 0x1p-20), d = separation() / corners().unit;
  const double noise = kStartNoise * corners().rho;
  const Parting parting = find_parting_of(start, d, start.lower <= 0 && touches_at_start());
  StoredLimit limit{};
  limit.found.unit = corners().unit, limit.found.t = parting.t;
  limit.found.verdict = parting.t == 1 ? Verdict::free : Verdict::max_checks;
  note_kept(0);
  if (start.lower <= 2 * rounding + 8 * noise) {
    limit.from = clear_time(rounding + 2 * noise);
    const bool clears = limit.from < parting.t;
    KernelResult clear{};
    if (clears) clear = limit_from(bounds_at(limit.from), limit.from, rounding - d);
    if (!clears || (clear.verdict != Verdict::free && clear.t < parting.t)) {
      limit.from = INFINITY;  // not known to stay clear
      limit.found.t = 0, limit.found.verdict = Verdict::max_checks;
      return limit;
    }
  }
  const double kept = std::min(kStoredRoundings * rounding, 0.5 * parting.excess);
  if (parting.t < 1 && parting.apart && kept > rounding)
    limit.found = limit_from(bounds_at(parting.t), parting.t, kept);
  return limit;
}

}  // namespace onset
