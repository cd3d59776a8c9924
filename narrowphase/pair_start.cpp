// How a pair starts, looked at with more care than in lanes.
#include <algorithm>
#include <cmath>

#include "narrowphase/distance/closest_points.hpp"
#include "narrowphase/distance/maximum_norm.hpp"
#include "narrowphase/pair_decision.hpp"

namespace onset {
namespace {

double least(const Corners& corners, double t, const Vec& w) {
  double at[4][3], r = INFINITY;
  corners.at(t, at);
  for (int k = 0; k < corners.count; ++k) r = std::min(r, dot(w, vec(at[k])));
  return r;
}

// Returns the time until which w, held fixed, certifies the pair beyond `wanted` from t on; t for none, 2 for
// the whole rest (docs/theory.md, L9).
double certified_until(const Corners& corners, const Vec& w, double norm, double wanted, double t) {
  const double bound = 4.25 * kU * corners.rho + wanted * norm * (1 + 0x1p-49);
  double until = 2;
  for (int k = 0; k < corners.count; ++k) {
    const double g0 = dot(w, vec(corners.c[0][k])) - bound, g1 = dot(w, vec(corners.c[1][k])) - bound;
    if (!((1 - t) * g0 + t * g1 > 0)) return t;
    if (g1 <= 0) until = std::min(until, g0 / (g0 - g1) * (1 - 0x1p-49));
    if (g0 <= 0 && g0 / (g0 - g1) * (1 + 0x1p-49) >= t) return t;
  }
  return std::max(until, t);
}

}  // namespace

bool PairDecision::is_welded() const {
  const int(&v)[4] = vertices();
  return in_.mesh.weld && is_seam(in_.motion, kind_, {v[0], v[1], v[2], v[3]});
}

PairDecision::Bounds PairDecision::bounds_at(double t) const {
  Bounds r{};
  const ExactPair pair = exact_pair_of_this();
  if (pairs_.maximum_norm) {
    r.w = best_direction_in_maximum_norm(PreciseMotion(kind_, pair.t0, pair.t1).at(t));
    const double size = sum_of_magnitudes(r.w);
    r.lower = size > 0 ? (least(corners(), t, r.w) - 8 * kU * corners().rho) / size * (1 - 0x1p-49) : 0;
    // The best direction shows all of the distance but rounding: 40u rho is proved (docs/theory.md, L44).
    r.upper = r.lower > 0 ? r.lower + 48 * kU * corners().rho : distance_at(t);
    return r;
  }
  const ClosestPoints found =
      t == 0 ? closest_points(kind_, pair.t0) : closest_points(kind_, pair.t0, pair.t1, t);
  r.w = vec(found.direction);
  r.lower = found.lower / corners().unit;
  r.upper = found.upper / corners().unit;
  return r;
}

Parting PairDecision::find_parting_of(const Bounds& start, double separation, bool touching) const {
  const ExactPair exact = exact_pair_of_this();
  const std::function<Vec(double)> direction = [&](double t) { return t == 0 ? start.w : bounds_at(t).w; };
  return find_parting({corners(), pairs_, row_, kind_, separation, direction, touching ? nullptr : &exact});
}

// Goes on at t, where `at` shows the pair beyond d + kept. Where the full demand certifies nothing, d + kept
// alone does: a start that is apart never gets 0 (docs/theory.md, T9).
KernelResult PairDecision::advance_from(const Bounds& at, double t, double kept) const {
  const double e7 = 7.25 * kU * corners().rho, unit = corners().unit, d = separation() / unit + kept;
  const double apart = at.lower - d;
  const double delta = std::max(std::min({pairs_.tolerance / unit, pairs_.sharpest, 0.25 * apart}), 16 * e7);
  const double norm = pairs_.maximum_norm ? sum_of_magnitudes(at.w) : 1;
  double until = certified_until(corners(), at.w, norm, d + 0.5 * delta, t);
  if (until == t) until = certified_until(corners(), at.w, norm, d, t);
  KernelResult r{};
  r.t = std::min(until, 1.0);
  r.distance = at.upper, r.delta = delta, r.separation = d, r.unit = unit, r.checks = 1;
  r.touched_by = 2;
  r.verdict = until > 1 ? Verdict::free : Verdict::max_checks;
  if (until > 1 || pairs_.max_checks <= 1) return r;
  const KernelResume resume{r.t, d, delta, 1, 0};
  advance(&resume, r);
  return r;
}

}  // namespace onset
