#include "src/truncate/plane_limits.hpp"

#include <algorithm>
#include <cmath>

#include "narrowphase/plane/plane_decision.hpp"
#include "scene/pairs/separation.hpp"

namespace onset {

double PlaneLimits::separation(int vertex) const { return separation_from_planes(mesh_, options_, vertex); }

void PlaneLimits::add(std::size_t most, Budget& budget, Gathered<MotionLimit>& all) const {
  const bool maximum_norm = options_.norm == Norm::maximum;
  gather_planes(
      blocks_, most, budget,
      [&](const PlaneBlock& block, int v, std::vector<MotionLimit>& found) {
        const OrientedPlane& n = *block.plane;
        const double *x0 = motion_.t0(v), d = separation(v);
        const PlaneSpan span(n, x0, motion_.t1(v));
        if (span.stays_beyond(n, d, options_.gap_share)) return;
        const PlaneStart start = start_at_plane(n, question_of(n, x0, x0, d, maximum_norm));
        if (!start.touches && std::equal(x0, x0 + 3, motion_.t1(v))) return;  // it may stay where it is
        MotionLimit limit{};
        limit.pair = {PairKind::vertex_plane, v, block.row, {v, -1, -1, -1}};
        limit.touches = start.touches, limit.has_plane = !start.touches, limit.starts_within = start.within;
        const double least = d * n.norm;
        limit.plane.first = std::min(span.start, least + options_.gap_share * (span.start - least));
        found.push_back(limit);
      },
      [](const MotionLimit& limit) {
        return IdPair{limit.pair.a, limit.pair.b};
      },
      all);
}

// Where two heights differ by no more than their errors, integers decide.
bool PlaneLimits::comes_no_closer(const MotionLimit& limit, const double* x) const {
  const OrientedPlane& n = blocks_.planes()[std::size_t(limit.pair.b)];
  const double* x0 = motion_.t0(limit.pair.a);
  const PlaneSpan span(n, x0, x);
  const double rise = span.end - span.start;
  if (std::fabs(rise) > 2 * span.error && std::fabs(rise) < INFINITY) return rise > 0;
  return sign_of_motion(question_of(n, x0, x, 0, false)) >= 0;
}

// A height within its error of what it is to be decides nothing about the separation: integers do.
bool PlaneLimits::keeps(const MotionLimit& limit, const double* x) const {
  const OrientedPlane& n = blocks_.planes()[std::size_t(limit.pair.b)];
  if (limit.starts_within) return comes_no_closer(limit, x);
  const PlaneSpan span(n, x, x);
  if (!(span.start >= limit.plane.first)) return false;
  const double d = separation(limit.pair.a);
  if (span.stays_beyond(n, d, 0)) return true;
  return !start_at_plane(n, question_of(n, x, x, d, options_.norm == Norm::maximum)).within;
}

PlaneLimits::Heights PlaneLimits::heights(const MotionLimit& limit) const {
  if (limit.starts_within) return {0, comes_no_closer(limit, motion_.t1(limit.pair.a)) ? 0.0 : -1.0, 0};
  const PlaneSpan span(blocks_.planes()[std::size_t(limit.pair.b)], motion_.t0(limit.pair.a),
                       motion_.t1(limit.pair.a));
  return {span.start - limit.plane.first, span.end - limit.plane.first, span.error};
}

}  // namespace onset
