// How far a pair lets a step go whose end is stored in doubles.
//
// Rounding in any order changes a stored distance by at most a bound R of its own coordinates (rounding_of_distances). So a step may
// end where the pair is beyond d + R, after an exact motion that keeps beyond d. Most pairs start with room for that and keep it on
// the whole way: they limit the step by a time. A pair whose gap is smaller may only end the step once it has cleared R: at 0, or
// from a time on.
#include <algorithm>
#include <cmath>

#include "narrowphase/pair_decision.hpp"
#include "scene/motion.hpp"

namespace onset {

struct NarrowPhase::StoredLimit {
  double from = 0;  // a step may end at 0 or in [from, found.t]; anywhere from `from` on where the verdict is free
  KernelResult found{};
};

double NarrowPhase::storing_rounding(const Case& c, const Corners& corners) const {
  double largest = 0;
  for (const int v : c.vertices())
    for (int a = 0; a < 3; ++a)
      largest = std::max({largest, std::fabs(in_.motion.t0(v)[a]), std::fabs(in_.motion.t1(v)[a])});
  return (c.input.storing * largest + kStoredLeast) / corners.unit * (1 + 0x1p-50);
}

// The exact motion of this pair alone, as an active set decides it.
void NarrowPhase::decide(const Case& c, NarrowPhaseStats& stats, std::vector<PairResult>& out) const {
  if (in_.contacts != nullptr && !in_.contacts->holds(in_.contacts->context, c.kind, c.pair)) return;
  KernelPairs one = c.input;
  one.vertices += c.row, one.separation += c.row, one.count = 1;
  if (NarrowPhaseScratch scratch; scratch.survivors.resize(1), cull(c.kind, one, scratch) == 0) return;
  KernelResult r;
  advance(c, nullptr, r);
  if (r.verdict == Verdict::free) return;
  if (in_.options.exactness != Exactness::conservative) certify(c.kind, c.input, &c.row, 1, &r);
  if (in_.options.narrow_phase == NarrowPhaseMethod::inclusion) r.checks = 0;
  stats.checks += r.checks;
  finish(c, r, 0, stats, out);
}

void NarrowPhase::note_kept(const Case& c, double share, NarrowPhaseStats& stats) const {
  if (share >= in_.gap_share * (1 - 0x1p-20)) return;
  NarrowPhaseStats here;
  here.least_share = share;
  here.closest = c.pair;
  stats.add(here);
}

void NarrowPhase::finish_stored(const Case& c, const KernelResult& checked, NarrowPhaseStats& stats,
                                std::vector<PairResult>& out) const {
  const KernelPairs plain = without_storing(c.input, 1);  // so that what it says does not depend on t_max
  const Case exact{c.kind, c.pair, plain, c.row};
  std::vector<PairResult> contact;  // of the exact motion: one at most
  StoredLimit limit{0, checked};
  bool searched = false;
  if (checked.verdict == Verdict::initial) {
    if (is_welded(c)) return;
    limit = limit_from_start(c, exact, stats, contact);
  } else {
    limit.found = carry_on(c, checked, stats, searched);
    decide(exact, stats, contact);
  }
  KernelResult& found = limit.found;
  // No contact, or a time of contact known exactly: then rounding alone limits the step, and the tolerance has no part in it.
  // So it is not where a share of the gap is kept.
  const bool sharper = in_.gap_share == 0 && (contact.empty() || times_are_exact());
  if (sharper && found.verdict == Verdict::contact && found.t > 0) {
    found.delta = kLeastTolerance * corners_of(c).rho;
    found.verdict = found.checks < c.input.max_checks ? Verdict::stalled : Verdict::max_checks;
    found = carry_on(c, found, stats, searched);
  }
  const bool free = found.verdict == Verdict::free;
  if (free && limit.from == 0 && contact.empty()) return;
  // A share that would be lost is a contact with what is kept.
  const bool spent = found.verdict == Verdict::max_checks && found.t > 0 && found.checks >= c.input.max_checks;
  const PairOutcome outcome = spent                            ? PairOutcome::max_checks
                          : in_.gap_share > 0 && found.t > 0 ? PairOutcome::contact
                                                        : PairOutcome::below_rounding;
  PairResult r{c.pair, INFINITY, INFINITY, 0, outcome};
  if (!contact.empty())
    r = contact[0];
  else if (!free)
    r.tolerance = std::max(0.0, (distance_at(exact, found.t) - c.separation() / found.unit) * found.unit);
  r.stored_limit = std::min(free ? INFINITY : found.t, r.step_limit);
  r.clear_from = limit.from;
  out.push_back(r);
}

// Goes on at time t, where it is as `at` says, to the end of this limit.
KernelResult NarrowPhase::limit_from(const Case& c, const Corners& corners, const Bounds& at, double t, double kept,
                                     NarrowPhaseStats& stats) const {
  const KernelResult found = advance_from(c, corners, at, t, kept);
  stats.checks += found.checks;
  bool searched = false;
  return carry_on(c, found, stats, searched);
}

// The first of some times from which on the pair is beyond `wanted`; infinite where it is at none of them.
double NarrowPhase::clear_time(const Case& c, const Corners& corners, double wanted) const {
  for (double t = 0x1p-52; t <= 1; t *= 16)
    if (bounds_at(c, corners, t).lower > wanted) return t;
  return INFINITY;
}

NarrowPhase::StoredLimit NarrowPhase::limit_from_start(const Case& c, const Case& exact, NarrowPhaseStats& stats,
                                                       std::vector<PairResult>& contact) const {
  const Corners corners = corners_of(c);
  const Bounds start = bounds_at(c, corners, 0);
  const double d = c.separation() / corners.unit, rounding = storing_rounding(c, corners), gap = start.upper - d;
  const double apart = start.lower - d, wanted = in_.gap_share * gap + kStoredRoundings * rounding;
  const double kept = std::min({wanted, 0.5 * (1 + in_.gap_share) * apart, apart - 2 * kStartNoise * corners.rho});
  if (kept > rounding) {
    note_kept(c, (kept - rounding) / gap, stats);
    const StoredLimit limit{0, limit_from(c, corners, start, 0, kept, stats)};
    decide(exact, stats, contact);
    return limit;
  }
  decide(exact, stats, contact);
  const PairOutcome outcome = contact.empty() ? PairOutcome::free : contact[0].outcome;
  KernelResult blocked{};
  blocked.unit = corners.unit, blocked.verdict = Verdict::max_checks;
  if (outcome == PairOutcome::initial_contact) return {0, blocked};
  if (rests(exact_pair_of(c))) {  // nothing is rounded
    blocked.verdict = Verdict::free;
    return {0, blocked};
  }
  if (outcome == PairOutcome::initial_separating) return limit_after_parting(c, corners, start, stats);
  return limit_of_small_gap(c, corners, contact, stats);
}

// Beyond d at the start by less than storing can close: the step may end where the pair is clear of that.
NarrowPhase::StoredLimit NarrowPhase::limit_of_small_gap(const Case& c, const Corners& corners,
                                                         const std::vector<PairResult>& contact,
                                                         NarrowPhaseStats& stats) const {
  const double d = c.separation() / corners.unit, kept = storing_rounding(c, corners) * (1 + 0x1p-20);
  const double clear = clear_time(c, corners, d + kept + 2 * kStartNoise * corners.rho);
  note_kept(c, 0, stats);
  if (clear > 1 || (!contact.empty() && clear >= contact[0].toi)) {
    StoredLimit blocked{};
    blocked.found.unit = corners.unit, blocked.found.verdict = Verdict::max_checks;
    return blocked;
  }
  return {clear, limit_from(c, corners, bounds_at(c, corners, clear), clear, kept, stats)};
}

// Within d at the start, and parting: its distance does not fall below what it is at the start, but for the noise of a look. Stored, it
// must not touch: where that is close, the step may end once the pair is clear, and certified to be so until it has parted.
NarrowPhase::StoredLimit NarrowPhase::limit_after_parting(const Case& c, const Corners& corners, const Bounds& start,
                                                          NarrowPhaseStats& stats) const {
  const double rounding = storing_rounding(c, corners) * (1 + 0x1p-20), d = c.separation() / corners.unit;
  const double noise = kStartNoise * corners.rho;
  const Parting parting = find_parting_of(c, corners, start, d, start.lower <= 0 && touches_at_start(c));
  StoredLimit limit{};
  limit.found.unit = corners.unit, limit.found.t = parting.t;
  limit.found.verdict = parting.t == 1 ? Verdict::free : Verdict::max_checks;
  note_kept(c, 0, stats);
  if (start.lower <= 2 * rounding + 8 * noise) {
    limit.from = clear_time(c, corners, rounding + 2 * noise);
    const bool clears = limit.from < parting.t;
    KernelResult clear{};
    if (clears)
      clear = limit_from(c, corners, bounds_at(c, corners, limit.from), limit.from, rounding - d, stats);
    if (!clears || (clear.verdict != Verdict::free && clear.t < parting.t)) {
      limit.from = INFINITY;  // not known to stay clear
      limit.found.t = 0, limit.found.verdict = Verdict::max_checks;
      return limit;
    }
  }
  const double kept = std::min(kStoredRoundings * rounding, 0.5 * parting.excess);
  if (parting.t < 1 && parting.apart && kept > rounding)
    limit.found = limit_from(c, corners, bounds_at(c, corners, parting.t), parting.t, kept, stats);
  return limit;
}

}  // namespace onset
