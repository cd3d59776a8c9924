#include "narrowphase/plane/plane_decision.hpp"

#include <algorithm>
#include <cmath>

#include "narrowphase/plane/exact_plane.hpp"
#include "scene/motion/motion.hpp"

namespace onset {
namespace {

// Scenes whose coordinates have a hundred bits in common take few limbs; all doubles together take 4,202 bits
// (products are from 2^-2148 to 2^2048), and a time 1,074 more.
using Common = ExactPlane<4, 7>;
using Widest = ExactPlane<67, 85>;
constexpr int kCommonBits = 4 * 64 - 5;

// What integers say of a question. `side` is the sign of the distance less the separation, and `excess` how
// much that is, times the length of n; `sign` and `value` are those of n.x - offset.
struct Decided {
  int side[2], sign, motion;
  // Around the time of contact, where the pair starts beyond its separation and ends within it.
  DoubleBracket time{};
  Approximation value[2], excess[2];
};

// Returns none where a time has more bits than fit.
template <class Exact>
std::optional<DoubleBracket> time_of_contact(const Exact& exact, const Decided& d) {
  if (d.side[1] == 0) return DoubleBracket{1, 1};
  const int by = std::max(d.excess[0].top(), d.excess[1].top());
  const double a = d.excess[0].scaled(by), b = d.excess[1].scaled(by);
  bool fits = true;
  const DoubleBracket r = adjacent_doubles(0, 1, a / (a - b), [&](double t) {
    fits = fits && Exact::fits(t);
    return fits ? exact.side_at(t) : 0;
  });
  if (!fits) return std::nullopt;
  return r;
}

template <class Exact>
bool decide(const Exact& exact, Decided& d) {
  d.sign = exact.sign(0), d.motion = exact.sign_of_motion();
  for (int end = 0; end < 2; ++end) {
    d.side[end] = exact.side(end);
    d.value[end] = exact.value(end), d.excess[end] = exact.excess(end);
  }
  if (d.side[0] <= 0 || d.side[1] > 0) return true;
  const auto time = time_of_contact(exact, d);
  if (time) d.time = *time;
  return time.has_value();
}

Decided decided(const PlaneQuestion& q) {
  const PlaneProducts products(q);
  Decided d;
  if (products.grid.bits() > kCommonBits || !decide(Common(products, q), d)) decide(Widest(products, q), d);
  return d;
}

// More than storing can change n.x - offset by, times 2^-by (docs/steps.md): 5u of the largest magnitude of
// each coordinate, and twice the smallest number where products underflow. 2^-1072 is for those here.
double storing_error(const OrientedPlane& n, const PlaneQuestion& q, int by) {
  double sum = 0;
  for (std::size_t a = 0; a < 3; ++a)
    sum += n.magnitude[a] * (5.25 * 0x1p-53 * std::max(std::fabs(q.x0[a]), std::fabs(q.x1[a])) + 0x1p-1073);
  return std::ldexp(sum * (1 + 0x1p-48) + 0x1p-1072, n.exponent - by) * (1 + 0x1p-50) + 0x1p-1074;
}

// How far a pair lets a step go whose end is stored, as narrowphase/stored_step.cpp has it for other pairs.
struct StoredPlane {
  const Decided& d;
  const PlaneQuestion& q;
  const PlaneAsk& ask;
  const IdPair pair;
  NarrowPhaseStats& stats;
  // All that follows is n.x - offset, scaled by 2^-by. Lower bounds of the excess at both ends: 2^-49 covers
  // the 5u of `excess`, and the smallest number what underflows.
  int by;
  double start, end, most, storing;
  // A step may end at 0 or in [from, until].
  double from = 0, until = INFINITY;

  StoredPlane(const Decided& decided, const OrientedPlane& n, const PlaneQuestion& question,
              const PlaneAsk& asked, IdPair ids, NarrowPhaseStats& s)
      : d(decided), q(question), ask(asked), pair(ids), stats(s) {
    by = std::max({d.excess[0].top(), d.excess[1].top(), d.value[0].top(), d.value[1].top()});
    start = below(d.excess[0].scaled(by)), end = below(d.excess[1].scaled(by));
    most = d.excess[0].scaled(by) * (1 + 0x1p-49) + 0x1p-1074;
    storing = storing_error(n, q, by) * (1 + 0x1p-20);
  }
  static double below(double x) { return x - std::fabs(x) * 0x1p-49 - 0x1p-1074; }

  // Returns a time in [0, 1] by which the line from a > kept at 0 to b has not come down to `kept`. The
  // quotient errs by 5u.
  static double above_until(double a, double b, double kept) {
    return b > kept ? INFINITY : std::max(0.0, (a - kept) / (a - b) * (1 - 0x1p-49));
  }
  // Returns a time from which on the line from a at 0 to b is above `kept`; infinite where it is not at 1.
  static double above_from(double a, double b, double kept) {
    if (a > kept) return 0;
    if (!(b > kept)) return INFINITY;
    return std::min(1.0, (kept - a) / (b - a) * (1 + 0x1p-49) + 0x1p-1074);
  }

  void note_kept(double share) {
    if (share >= ask.gap_share * (1 - 0x1p-20)) return;
    NarrowPhaseStats here;
    here.least_share = share;
    here.closest = pair;
    stats.add(here);
  }

  // A pair that starts beyond its separation keeps a share of its gap and four times what storing can change,
  // three of which are left for the next step.
  void limit_gap() {
    const double wanted = ask.gap_share * most + 4 * storing;
    const double kept = std::min(wanted, 0.5 * (1 + ask.gap_share) * start);
    if (kept > storing) {
      note_kept((kept - storing) / most);
      until = above_until(start, end, kept);
      return;
    }
    if (at_one_place(q.x0, q.x1)) return;  // nothing is rounded
    note_kept(0);
    from = d.motion < 0 ? INFINITY : above_from(start, end, storing);
    if (from > 1) from = until = 0;
  }

  // A pair that starts within its separation and parts must not touch once it is stored.
  void limit_parting() {
    if (at_one_place(q.x0, q.x1)) return;
    note_kept(0);
    from = above_from(below(d.value[0].scaled(by)), below(d.value[1].scaled(by)), storing);
    if (from > 1) from = until = 0;
  }
};

// A touching vertex came from the free side, or it is behind the plane by mistake: it blocks, as pairs do.
bool parts(const Decided& d, const PlaneQuestion& q, const PlaneAsk& ask) {
  if (d.sign > 0) return d.motion >= 0;
  return ask.touching_may_pass_through && (d.motion > 0 || at_one_place(q.x0, q.x1));
}

// Finds the contact of the exact motion.
std::optional<PairResult> contact(const Decided& d, const PlaneQuestion& q, const PlaneAsk& ask,
                                  IdPair pair) {
  PairResult r{pair, d.time.lo, d.time.lo, 0, PairOutcome::contact};
  if (d.side[0] > 0) {
    if (d.side[1] > 0) return std::nullopt;
    r.certainty = r.limit_certainty = Certainty::certain;
    r.toi_hi = d.time.hi;
    return r;
  }
  r.toi = r.step_limit = r.toi_hi = 0;
  r.certainty = Certainty::touching_at_start;
  if (parts(d, q, ask)) {
    r.outcome = PairOutcome::initial_separating;
    r.step_limit = INFINITY;
  } else {
    r.outcome = PairOutcome::initial_contact;
    r.limit_certainty = r.certainty;
  }
  return r;
}

// Answers with the numbers that are wide enough for a time. `ask` takes either kind.
template <class Ask>
auto of_exact(const PlaneQuestion& q, double t, const Ask& ask) {
  const PlaneProducts products(q);
  if (products.grid.bits() <= kCommonBits && Common::fits(t)) return ask(Common(products, q));
  return ask(Widest(products, q));
}

// The length of the plane's normal, scaled: its error is 4u.
double length(const OrientedPlane& n) {
  double squares = 0;
  for (const double x : n.scaled) squares += x * x;
  return std::sqrt(squares);
}
double over_length(const Approximation& a, const OrientedPlane& n) {
  return std::ldexp(a.mantissa / length(n), a.exponent - n.exponent);
}

}  // namespace

std::optional<PairResult> decide_plane(const OrientedPlane& plane, const PlaneQuestion& q,
                                       const PlaneAsk& ask, IdPair pair, NarrowPhaseStats& stats) {
  const Decided d = decided(q);
  std::optional<PairResult> r = contact(d, q, ask, pair);
  if (!ask.stored) return r;
  StoredPlane stored(d, plane, q, ask, pair, stats);
  if (d.side[0] > 0)
    stored.limit_gap();
  else if (r->outcome == PairOutcome::initial_separating)
    stored.limit_parting();
  else
    stored.until = 0;
  if (!r) {
    if (stored.from == 0 && stored.until > 1) return std::nullopt;
    r = PairResult{
        pair, INFINITY, INFINITY, 0,
        ask.gap_share > 0 && stored.until > 0 ? PairOutcome::contact : PairOutcome::below_rounding};
  }
  r->stored_limit = std::min(stored.until, r->step_limit);
  r->clear_from = stored.from;
  return r;
}

PlaneStart start_at_plane(const OrientedPlane& plane, const PlaneQuestion& q) {
  return of_exact(q, 0, [&](const auto& exact) -> PlaneStart {
    return {exact.sign(0) <= 0, exact.side(0) <= 0, std::max(0.0, over_length(exact.value(0), plane))};
  });
}

int sign_of_motion(const PlaneQuestion& q) {
  return of_exact(q, 0, [](const auto& exact) { return exact.sign_of_motion(); });
}

PlaneGeometry geometry_at_plane(const OrientedPlane& plane, const PlaneQuestion& q, double t) {
  return of_exact(q, t, [&](const auto& exact) -> PlaneGeometry {
    return {std::max(0.0, over_length(exact.value_at(t), plane)), over_length(exact.motion(), plane)};
  });
}

}  // namespace onset
