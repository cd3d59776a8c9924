#include "narrowphase/narrow_phase.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "narrowphase/inclusion.hpp"
#include "narrowphase/initial.hpp"
#include "narrowphase/interval_certificate.hpp"
#include "narrowphase/kernel/kernels.hpp"
#include "narrowphase/pair_decision.hpp"
#include "scene/pair_source.hpp"

namespace onset {
namespace {

// With fewer checks than this a pair may be reported far from contact, and t_max could hide it: then it
// is not used.
constexpr std::int64_t kChecksForTMax = 1000;

double power_of_two_near_one_over(double x) {
  return x > 0x1p-1000 ? std::ldexp(1.0, -std::ilogb(x)) : 0x1p1000;
}

}  // namespace

void NarrowPhaseStats::add(const NarrowPhaseStats& o) {
  candidates += o.candidates, after_culls += o.after_culls, inclusion += o.inclusion;
  contacts += o.contacts, gave_up += o.gave_up, checks += o.checks;
  const auto before = [](IdPair p, IdPair q) { return p.a != q.a ? p.a < q.a : p.b < q.b; };
  if (o.most_checks > most_checks || (o.most_checks == most_checks && before(o.worst, worst)))
    most_checks = o.most_checks, worst = o.worst;
  for (std::size_t k = 0; k < histogram.size(); ++k) histogram[k] += o.histogram[k];
  achieved_tolerance = std::max(achieved_tolerance, o.achieved_tolerance);
  const auto order = [](const NarrowPhaseStats& s) {
    return std::tuple(s.least_share, s.closest.a, s.closest.b);
  };
  if (order(o) < order(*this)) least_share = o.least_share, closest = o.closest;
}

void NarrowPhaseStats::note_checks(IdPair pair, std::int64_t n) {
  const int power = 63 - __builtin_clzll(static_cast<unsigned long long>(n) | 1);
  ++histogram[std::size_t(std::min(power, 15))];
  if (n < most_checks || n == 0) return;
  if (n > most_checks || pair.a < worst.a || (pair.a == worst.a && pair.b < worst.b)) worst = pair;
  most_checks = n;
}

void NarrowPhaseStats::note_outcome(const PairResult& r) {
  gave_up += r.outcome == PairOutcome::max_checks;
  achieved_tolerance = std::max(achieved_tolerance, r.tolerance);
}

NarrowPhase::NarrowPhase(const NarrowPhaseInput& input)
    : in_(input),
      kernels_(&kernels_for(input.options.instruction_set)),
      scale_(power_of_two_near_one_over(input.extent)) {
  if (input.for_many) rounded_ = round_positions(input.motion, scale_);
}

// Advancement stops within max(tolerance, 16 E7), E7 = 7.25u rho with rho <= sqrt(3) extent: 201u extent; the
// inclusion root finder within that and its corners' errors.
double reported_within(double tolerance, double extent) {
  return std::max(tolerance, 0x1p-45 * extent + 0x1p-1070) * (1 + 0x1p-40);
}

bool NarrowPhase::uses_t_max() const { return in_.options.max_checks >= kChecksForTMax; }

void NarrowPhase::gather(PairKind kind, const IdPair* pairs, std::size_t count,
                          NarrowPhaseScratch& scratch) const {
  scratch.vertices.resize(4 * count);
  scratch.survivors.resize(count);
  if (kind == PairKind::vertex_face)
    for (std::size_t i = 0; i < count; ++i)
      put_vertices(in_.mesh, PairKind::vertex_face, pairs[i], &scratch.vertices[4 * i]);
  else
    for (std::size_t i = 0; i < count; ++i)
      put_vertices(in_.mesh, PairKind::edge_edge, pairs[i], &scratch.vertices[4 * i]);
  scratch.separation.assign(count, in_.options.min_separation);
  if (in_.mesh.thickness.empty()) return;
  const int first_side = kind == PairKind::vertex_face ? 1 : 2;
  for (std::size_t i = 0; i < count; ++i) {  // two sums: rounded up
    const int* v = &scratch.vertices[4 * i];
    scratch.separation[i] = (in_.options.min_separation + thickest(in_.mesh, v, v + first_side) +
                             thickest(in_.mesh, v + first_side, v + 4)) *
                            (1 + 0x1p-51);
  }
}

KernelPairs NarrowPhase::prepare(PairKind kind, const IdPair* pairs, std::size_t count, TMax t_max,
                                 NarrowPhaseScratch& scratch) const {
  gather(kind, pairs, count, scratch);
  // The inclusion root finder takes over after one check, which finds the pairs that start within d and the
  // tolerance to use.
  const bool inclusion_only = in_.options.narrow_phase == NarrowPhaseMethod::inclusion;
  return {in_.motion.x.data(),
          rounded_.data(),
          reinterpret_cast<const int(*)[4]>(scratch.vertices.data()),
          scratch.separation.data(),
          int(count),
          scale_,
          inclusion_only ? in_.tolerance : kSharpness * in_.tolerance,
          inclusion_only ? 2 : kSharpest,
          reported_within(in_.tolerance, in_.extent),
          in_.gap_share,
          in_.stored ? kStoring : 0,
          in_.stored ? kStoredRoundings * in_.rounding : 0,
          uses_t_max() ? std::min(t_max.culls, 1.0) : 1,
          uses_t_max() ? std::min(t_max.advancement, 1.0) : 1,
          in_.options.norm == Norm::maximum,
          inclusion_only ? 1 : static_cast<long long>(in_.options.max_checks)};
}

KernelPairs NarrowPhase::without_storing(KernelPairs pairs, double t_max) {
  pairs.gap_share = pairs.storing = pairs.cull_beyond = 0;
  pairs.t_max = pairs.cull_t_max = t_max;
  return pairs;
}

int NarrowPhase::cull(PairKind kind, const KernelPairs& input, NarrowPhaseScratch& scratch) const {
  if (in_.options.narrow_phase == NarrowPhaseMethod::inclusion) {
    for (int i = 0; i < input.count; ++i) scratch.survivors[std::size_t(i)] = i;
    return input.count;
  }
  const auto cull = kernels_->of_kind[int(kind)].cull;
  return cull(input, scratch.survivors.data());
}

void NarrowPhase::cull(PairKind kind, const IdPair* pairs, std::size_t count, NarrowPhaseScratch& scratch,
                       std::vector<IdPair>& out) const {
  const int survivors = cull(kind, prepare(kind, pairs, count, {}, scratch), scratch);
  for (int i = 0; i < survivors; ++i) out.push_back(pairs[scratch.survivors[std::size_t(i)]]);
}

void NarrowPhase::process(PairKind kind, const IdPair* pairs, std::size_t count, TMax t_max,
                          NarrowPhaseScratch& scratch, std::vector<PairResult>& out) const {
  if (count == 0) return;
  const KernelPairs input = prepare(kind, pairs, count, t_max, scratch);
  const int survivors = cull(kind, input, scratch);
  scratch.results.resize(std::size_t(survivors));
  advance(kind, input, scratch.survivors.data(), survivors, nullptr, scratch.results.data());
  if (in_.stored) {
    advance_exactly(kind, input, survivors, scratch);
  } else if (in_.options.exactness != Exactness::conservative) {
    certify(kind, input, scratch.survivors.data(), survivors, scratch.results.data());
  }
  scratch.stats.candidates += std::int64_t(count);
  scratch.stats.after_culls += survivors;
  for (int i = 0; i < survivors; ++i) {
    const int row = scratch.survivors[std::size_t(i)];
    KernelResult& r = scratch.results[std::size_t(i)];
    if (in_.options.narrow_phase == NarrowPhaseMethod::inclusion) r.checks = 0;  // its checks are boxes
    const std::int64_t before = scratch.stats.checks;
    scratch.stats.checks += r.checks;
    const Case c{kind, pairs[row], input, row};
    if (in_.stored && (r.verdict != Verdict::free || scratch.touches[std::size_t(i)]))
      finish_stored(c, r, scratch.stats, out);
    else if (!in_.stored && r.verdict != Verdict::free)
      finish(c, r, 0, scratch.stats, out);
    scratch.stats.note_checks(pairs[row], scratch.stats.checks - before);
  }
}

// What the exact motion says of the pairs that `results` are of, too: within the tolerance the two can differ. A pair that is free after
// its first check is so with a smaller demand from the same look.
void NarrowPhase::advance_exactly(PairKind kind, const KernelPairs& input, int survivors, NarrowPhaseScratch& scratch) const {
  scratch.touches.assign(std::size_t(survivors), 0);
  scratch.asked.clear();
  scratch.places.clear();
  for (int i = 0; i < survivors; ++i) {
    const KernelResult& r = scratch.results[std::size_t(i)];
    if (r.verdict != Verdict::free || r.checks <= 1) continue;
    scratch.asked.push_back(scratch.survivors[std::size_t(i)]);
    scratch.places.push_back(i);
  }
  if (scratch.asked.empty()) return;
  scratch.exact_results.resize(scratch.asked.size());
  advance(kind, without_storing(input, input.t_max), scratch.asked.data(), int(scratch.asked.size()), nullptr,
          scratch.exact_results.data());
  for (std::size_t k = 0; k < scratch.asked.size(); ++k)
    scratch.touches[std::size_t(scratch.places[k])] = scratch.exact_results[k].verdict != Verdict::free;
}

double NarrowPhase::distance_at(const Case& c, double t) const {
  double w[3];
  return kernels_->of_kind[int(c.kind)].closest_direction(c.input, c.row, t, w);
}

Corners NarrowPhase::corners_of(const Case& c) const { return make_corners(c.kind, in_.motion, c.vertices()); }

void NarrowPhase::advance(PairKind kind, const KernelPairs& pairs, const int* rows, int count,
                          const KernelResume* resume, KernelResult* results) const {
  kernels_->of_kind[int(kind)].advance(pairs, rows, count, resume, results);
}
void NarrowPhase::advance(const Case& c, const KernelResume* resume, KernelResult& result) const {
  advance(c.kind, c.input, &c.row, 1, resume, &result);
}
void NarrowPhase::certify(PairKind kind, const KernelPairs& pairs, const int* rows, int count,
                          KernelResult* results) const {
  kernels_->of_kind[int(kind)].certify(pairs, rows, count, results);
}

// A pair that crawls: certify an interval and go on, or go on regardless for a while. Real contacts of
// degenerate pairs converge slowly but steadily; what neither finishes is left for the inclusion root finder.
KernelResult NarrowPhase::push_on(const Case& c, const Corners& corners, KernelResult r) const {
  constexpr double kPatience = 200;
  const double wanted = (r.separation + 0.5 * r.delta) * (1 + 0x1p-49);
  bool patient = false;
  for (int rounds = 0; rounds < 64 && r.verdict == Verdict::stalled; ++rounds) {
    const double t = certify_interval(corners, r.t, wanted, c.input.maximum_norm);
    ++r.checks;
    if (t >= 1) {
      r.t = 1;
      r.verdict = Verdict::free;
      return r;
    }
    if (t == r.t && patient) return r;
    if (r.checks >= c.input.max_checks) {
      r.t = t;
      r.verdict = Verdict::max_checks;
      return r;
    }
    patient = t == r.t;
    const KernelResume resume{t, r.separation, r.delta, r.checks, patient ? kPatience : 0};
    advance(c, &resume, r);
  }
  return r;
}

// From where a pair stalled on, to free, contact or a spent budget. `searched`: by the inclusion root finder, whose
// bound of the distance is then the result's.
KernelResult NarrowPhase::carry_on(const Case& c, const KernelResult& checked, NarrowPhaseStats& stats,
                                   bool& searched) const {
  const bool inclusion_only = in_.options.narrow_phase == NarrowPhaseMethod::inclusion;
  KernelResult found = checked;
  if (!inclusion_only && found.verdict == Verdict::stalled) found = push_on(c, corners_of(c), found);
  stats.checks += found.checks - checked.checks;
  searched = found.verdict == Verdict::stalled || (found.verdict == Verdict::max_checks && inclusion_only);
  if (!searched) return found;
  const InclusionResult result =
      find_first_inclusion({corners_of(c), found.t, found.separation, found.delta,
                            in_.options.norm == Norm::maximum, in_.options.max_checks - found.checks});
  ++stats.inclusion;
  stats.checks += result.checks;
  found.t = result.t;
  found.distance = result.distance;
  found.verdict = result.end == InclusionResult::End::free     ? Verdict::free
                  : result.end == InclusionResult::End::max_checks ? Verdict::max_checks
                                                               : Verdict::contact;
  return found;
}

void NarrowPhase::finish(const Case& c, const KernelResult& checked, double from, NarrowPhaseStats& stats,
                         std::vector<PairResult>& out) const {
  KernelResult found = checked;
  PairResult r{c.pair, 0, 0, 0, PairOutcome::contact};
  const double d = found.separation;
  Corners corners;
  Bounds start{};
  if (found.verdict == Verdict::initial) {
    if (is_welded(c)) return;
    corners = corners_of(c);
    if (d > 0) start = bounds_at(c, corners, 0);
    if (d > 0 && start.lower - d > kStartNoise * corners.rho) {
      found = advance_from(c, corners, start, 0, 0);
      stats.checks += found.checks - checked.checks;
    }
  }
  // What stalls is asked first whether it touches at all: that takes less than to find out in doubles.
  ExactAnswer exact{Answer::unknown, {}};
  if (in_.options.narrow_phase != NarrowPhaseMethod::inclusion && found.verdict == Verdict::stalled)
    exact = decide_exactly(c, found, from);
  bool searched = false;
  if (exact.answer == Answer::unknown) found = carry_on(c, found, stats, searched);
  if (found.verdict == Verdict::free) return;
  if (exact.answer == Answer::unknown) exact = decide_exactly(c, found, from);
  if (exact.answer == Answer::no) return;
  const bool real = exact.answer == Answer::yes;
  if (found.verdict == Verdict::initial && !(real && exact.time.lo > 0))
    return finish_initial(c, corners, d > 0 ? start : bounds_at(c, corners, 0), found, exact, stats, out);
  const bool later =
      real && exact.time.lo > found.t && (in_.exact_times || found.verdict != Verdict::contact);
  if (later) found.t = exact.time.lo;
  // These moved on after their last look; where the inclusion root finder did, it has a bound of its own,
  // which is the sharper one for slivers.
  if (found.verdict != Verdict::contact || found.checks <= 1 || later) {
    const double known = searched && !later ? found.distance : INFINITY;
    found.distance = std::min(known, distance_at(c, found.t));
  }
  // Corners move by at most 2 rho in the whole step, so far apart is a pair that has touched by time.hi.
  if (later)
    found.distance = std::min(
        found.distance, 2 * corners_of(c).rho * (exact.time.hi - exact.time.lo) * (1 + 0x1p-40) + 0x1p-1074);
  if (found.verdict == Verdict::max_checks && !real) r.outcome = PairOutcome::max_checks;
  r.toi = r.step_limit = found.t;
  if (real || seen_within_separation(c, found)) r.certainty = r.limit_certainty = Certainty::certain;
  if (real && from == 0) r.toi_hi = exact.time.hi;
  r.tolerance = std::max(0.0, (found.distance - d) * found.unit);
  out.push_back(r);
}

// Touching or closer than d at the start. From which side a pair came that touches is not known: it blocks the step, unless
// the caller says otherwise. Where the motion parts the others the step goes on, to the next contact if there is one.
void NarrowPhase::finish_initial(const Case& c, const Corners& corners, const Bounds& start,
                                 const KernelResult& found, const ExactAnswer& exact, NarrowPhaseStats& stats,
                                 std::vector<PairResult>& out) const {
  const double d = found.separation;
  PairResult r{c.pair, 0, 0, std::max(0.0, (std::min(start.upper, found.distance) - d) * found.unit),
               PairOutcome::initial_contact};
  const bool touching =
      exact.answer == Answer::yes ? exact.time.hi == 0 : start.lower <= 0 && touches_at_start(c);
  if (touching || start.upper <= d)
    r.certainty = Certainty::touching_at_start;
  else if (exact.answer == Answer::yes)
    r.certainty = Certainty::certain;
  if (touching) r.toi_hi = 0;
  if (exact.answer == Answer::yes) r.toi_hi = exact.time.hi;
  Parting parting;
  if (!touching || in_.options.touching_may_pass_through) parting = find_parting_of(c, corners, start, d, touching);
  if (parting.t > 0) r.outcome = PairOutcome::initial_separating;
  r.step_limit = parting.t == 1 ? INFINITY : parting.t;
  if (parting.t == 0) r.limit_certainty = r.certainty;
  if (parting.apart && parting.t < 1) {
    const double floor = kLeastTolerance * corners.rho;  // as at a start that is apart
    KernelResult later = found;
    later.t = parting.t;
    later.delta = std::max(
        std::min({kSharpness * in_.tolerance / found.unit, kSharpest, 0.25 * parting.excess}), floor);
    later.verdict = later.checks < in_.options.max_checks ? Verdict::stalled : Verdict::max_checks;
    std::vector<PairResult> next;
    KernelPairs whole = c.input;
    whole.t_max = whole.cull_t_max = 1;  // what is reported at 0 is reported with its step_limit
    finish({c.kind, c.pair, whole, c.row}, later, parting.t, stats, next);
    r.step_limit = INFINITY;
    if (!next.empty()) {
      r.step_limit = next[0].step_limit, r.limit_certainty = next[0].certainty;
      stats.note_outcome(next[0]);
    }
  }
  out.push_back(r);
}

}  // namespace onset
