#include "narrowphase/pair_decision.hpp"

#include <algorithm>
#include <cmath>

#include "base/assert.hpp"
#include "narrowphase/inclusion.hpp"
#include "narrowphase/interval_certificate.hpp"

namespace onset {

KernelPairs without_storing(KernelPairs pairs, double t_max) {
  pairs.gap_share = pairs.storing = pairs.cull_beyond = 0;
  pairs.t_max = pairs.cull_t_max = t_max;
  return pairs;
}

const Corners& PairDecision::corners() const {
  if (!corners_) corners_ = make_corners(kind_, in_.motion, vertices());
  return *corners_;
}

double PairDecision::distance_at(double t) const {
  double w[3];
  return kernels_.closest_direction(pairs_, row_, t, w);
}

void PairDecision::advance(const KernelResume* resume, KernelResult& result) const {
  kernels_.advance(pairs_, &row_, 1, resume, &result);
}

std::optional<PairResult> PairDecision::contact(const KernelResult& checked, double from) {
  ONSET_ASSERT(from >= 0 && from <= 1 && checked.t >= from);
  KernelResult found = checked;
  Bounds start{};
  if (found.verdict == Verdict::initial) {
    if (is_welded()) return std::nullopt;
    const double d = found.separation;
    if (d > 0) start = bounds_at(0);
    if (d > 0 && start.lower - d > kStartNoise * corners().rho) {
      found = advance_from(start, 0, 0);
      stats_.checks += found.checks - checked.checks;
    }
  }
  ExactAnswer exact{Answer::unknown, {}};
  if (!in_.inclusion_only() && found.verdict == Verdict::stalled) exact = decide_exactly(found, from);
  bool searched = false;
  // Integers do not say when a pair touches again that touched before `from`.
  if (exact.answer == Answer::unknown || (exact.answer == Answer::yes && from > 0))
    found = carry_on(found, searched);
  if (found.verdict == Verdict::free) return std::nullopt;
  if (exact.answer == Answer::unknown) exact = decide_exactly(found, from);
  if (exact.answer == Answer::no) return std::nullopt;
  const bool at_start =
      found.verdict == Verdict::initial && !(exact.answer == Answer::yes && exact.time.lo > 0);
  if (!at_start) return report(found, exact, from, searched);
  return contact_at_start(found.separation > 0 ? start : bounds_at(0), found, exact);
}

// Certifies intervals, or goes on regardless for a while, as contacts of degenerate pairs converge slowly but
// steadily. What neither finishes is left for the inclusion root finder.
KernelResult PairDecision::push_on(KernelResult r) const {
  constexpr double kPatience = 200;
  const double wanted = (r.separation + 0.5 * r.delta) * (1 + 0x1p-49);
  bool patient = false;
  for (int rounds = 0; rounds < 64 && r.verdict == Verdict::stalled; ++rounds) {
    ONSET_ASSERT(r.checks < pairs_.max_checks);  // or the verdict would be that
    const double t = certify_interval(corners(), r.t, wanted, pairs_.maximum_norm);
    ++r.checks;
    if (t >= 1) {
      r.t = 1;
      r.verdict = Verdict::free;
      return r;
    }
    if (t == r.t && patient) return r;
    if (r.checks >= pairs_.max_checks) {
      r.t = t;
      r.verdict = Verdict::max_checks;
      return r;
    }
    ONSET_ASSERT(t >= r.t);
    patient = t == r.t;
    const KernelResume resume{t, r.separation, r.delta, r.checks, patient ? kPatience : 0};
    advance(&resume, r);
  }
  return r;
}

KernelResult PairDecision::search(KernelResult found) {
  const InclusionResult result =
      find_first_inclusion({corners(), found.t, found.separation, found.delta,
                            in_.options.norm == Norm::maximum, in_.options.max_checks - found.checks});
  ++stats_.inclusion;
  stats_.checks += result.checks;
  found.t = result.t;
  found.distance = result.distance;
  found.verdict = result.end == InclusionResult::End::free         ? Verdict::free
                  : result.end == InclusionResult::End::max_checks ? Verdict::max_checks
                                                                   : Verdict::contact;
  return found;
}

KernelResult PairDecision::carry_on(const KernelResult& checked, bool& searched) {
  KernelResult found = checked;
  if (!in_.inclusion_only() && found.verdict == Verdict::stalled) found = push_on(found);
  stats_.checks += found.checks - checked.checks;
  const bool spent = found.checks >= in_.options.max_checks;
  if (spent && found.verdict == Verdict::stalled) found.verdict = Verdict::max_checks;
  searched = !spent && (found.verdict == Verdict::stalled ||
                        (found.verdict == Verdict::max_checks && in_.inclusion_only()));
  return searched ? search(found) : found;
}

PairResult PairDecision::report(KernelResult found, const ExactAnswer& exact, double from,
                                bool searched) const {
  const bool real = exact.answer == Answer::yes;
  const bool later =
      real && exact.time.lo > found.t && (in_.exact_times || found.verdict != Verdict::contact);
  if (later) found.t = exact.time.lo;
  ONSET_ASSERT(found.t >= 0 && found.t <= 1);
  // These moved on after their last look. The inclusion root finder's own bound is sharper for slivers.
  if (later)
    found.distance = distance_before_touching(exact.time);
  else if (found.verdict != Verdict::contact || found.checks <= 1)
    found.distance = std::min(searched ? found.distance : INFINITY, distance_at(found.t));
  PairResult r{pair_, found.t, found.t, std::max(0.0, (found.distance - found.separation) * found.unit),
               PairOutcome::contact};
  if (found.verdict == Verdict::max_checks && !real) r.outcome = PairOutcome::max_checks;
  if (real || seen_within_separation(found)) r.certainty = r.limit_certainty = Certainty::certain;
  if (real && from == 0) r.toi_hi = exact.time.hi;
  return r;
}

// Reports a pair that touches or is closer than d at the start. The side that a touching one came from is not
// known: it blocks the step, unless the caller says otherwise. Where the motion parts others, the step goes
// on to the next contact.
PairResult PairDecision::contact_at_start(const Bounds& start, const KernelResult& found,
                                          const ExactAnswer& exact) {
  const double d = found.separation;
  PairResult r{pair_, 0, 0, std::max(0.0, (std::min(start.upper, found.distance) - d) * found.unit),
               PairOutcome::initial_contact};
  const bool touching =
      exact.answer == Answer::yes ? exact.time.hi == 0 : start.lower <= 0 && touches_at_start();
  if (touching || start.upper <= d)
    r.certainty = Certainty::touching_at_start;
  else if (exact.answer == Answer::yes)
    r.certainty = Certainty::certain;
  if (r.certainty == Certainty::touching_at_start) r.toi_hi = 0;
  if (exact.answer == Answer::yes) r.toi_hi = exact.time.hi;
  Parting parting;
  if (!touching || in_.options.touching_may_pass_through) parting = find_parting_of(start, d, touching);
  if (parting.t > 0) r.outcome = PairOutcome::initial_separating;
  r.step_limit = parting.t == 1 ? INFINITY : parting.t;
  if (parting.t == 0) r.limit_certainty = r.certainty;
  if (parting.apart && parting.t < 1) add_contact_after_parting(found, parting, r);
  return r;
}

// Decides the rest of the motion. What is reported at 0 has its step_limit whatever t_max is.
void PairDecision::add_contact_after_parting(const KernelResult& found, const Parting& parting,
                                             PairResult& r) {
  const double floor = kLeastTolerance * corners().rho;  // as at a start that is apart
  KernelResult later = found;
  later.t = parting.t;
  later.delta =
      std::max(std::min({kSharpness * in_.tolerance / found.unit, kSharpest, 0.25 * parting.excess}), floor);
  later.verdict = later.checks < in_.options.max_checks ? Verdict::stalled : Verdict::max_checks;
  KernelPairs whole = pairs_;
  whole.t_max = whole.cull_t_max = 1;
  const std::optional<PairResult> next = of(whole).contact(later, parting.t);
  r.step_limit = next ? next->step_limit : INFINITY;
  if (!next) return;
  r.limit_certainty = next->certainty;
  stats_.note_outcome(*next);
}

}  // namespace onset
