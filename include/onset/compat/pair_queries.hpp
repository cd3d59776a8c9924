// One pair of primitives asked about in the way that ipc-toolkit's classes ask: a time of impact that leaves
// a share of the gap, within a time limit. onset/compat/ipc.hpp and onset/compat/ipc_toolkit.hpp answer by
// these.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <onset/options.hpp>
#include <onset/query.hpp>
#include <onset/step_size.hpp>
#include <stdexcept>
#include <string>

namespace onset::compat {

// Both ends of the motion of one pair. vertex_face: v, f0, f1, f2; edge_edge: a0, a1, b0, b1, where a point
// is an edge of twice the same; vertex_edge, in the plane: v, e0, e1, the fourth not used.
struct PairMotion {
  PairKind kind = PairKind::vertex_face;
  std::array<Point, 4> t0{}, t1{};
  // Which of the pair's vertices each of the four is.
  std::array<std::size_t, 4> vertex{0, 1, 2, 3};
};

template <class Derived>
Point point_of(const Eigen::DenseBase<Derived>& x) {
  const auto& p = x.derived();
  if (p.size() != 3 && p.size() != 2)
    throw std::invalid_argument("a point has 2 or 3 coordinates, not " + std::to_string(p.size()));
  Point r{};
  for (Eigen::Index i = 0; i < p.size(); ++i) r[std::size_t(i)] = double(p(i));
  return r;
}

// Points of a query, all with as many coordinates as the first.
template <class P, class... More>
std::array<Point, 1 + sizeof...(More)> points_of(const P& first, const More&... more) {
  if (((more.size() != first.size()) || ...))
    throw std::invalid_argument("the points of a query have all 2 or all 3 coordinates");
  return {point_of(first), point_of(more)...};
}

// Makes the motion of a pair from points of type P, VectorXd and its like: in the plane where they have two
// coordinates.
template <class P>
PairMotion moving_points(const P& p_t0, const P& q_t0, const P& p_t1, const P& q_t1) {
  const auto x = points_of(p_t0, q_t0, p_t1, q_t1);
  if (p_t0.size() == 2)
    return {PairKind::vertex_edge, {x[0], x[1], x[1], x[1]}, {x[2], x[3], x[3], x[3]}, {0, 1, 1, 1}};
  return {PairKind::edge_edge, {x[0], x[0], x[1], x[1]}, {x[2], x[2], x[3], x[3]}, {0, 0, 1, 1}};
}
template <class P>
PairMotion moving_point_and_edge(const P& p_t0, const P& e0_t0, const P& e1_t0, const P& p_t1, const P& e0_t1,
                                 const P& e1_t1) {
  const auto x = points_of(p_t0, e0_t0, e1_t0, p_t1, e0_t1, e1_t1);
  if (p_t0.size() == 2)
    return {PairKind::vertex_edge, {x[0], x[1], x[2], x[2]}, {x[3], x[4], x[5], x[5]}, {0, 1, 2, 2}};
  return {PairKind::edge_edge, {x[0], x[0], x[1], x[2]}, {x[3], x[3], x[4], x[5]}, {0, 0, 1, 2}};
}

// The four points at the start, then those at the end, in the order of `kind`.
template <class P, class... More>
PairMotion moving_four(PairKind kind, const P& first, const More&... more) {
  const std::array<Point, 8> x = points_of(first, more...);
  return {kind, {x[0], x[1], x[2], x[3]}, {x[4], x[5], x[6], x[7]}, {0, 1, 2, 3}};
}

inline QueryResult ask(const PairMotion& motion, const Options& options) {
  if (motion.kind == PairKind::vertex_face) return vertex_face_ccd({motion.t0, motion.t1}, options);
  if (motion.kind == PairKind::edge_edge) return edge_edge_ccd({motion.t0, motion.t1}, options);
  VertexEdgeQuery q;
  for (std::size_t i = 0; i < 3; ++i)
    q.t0[i] = {motion.t0[i][0], motion.t0[i][1]}, q.t1[i] = {motion.t1[i][0], motion.t1[i][1]};
  return vertex_edge_ccd(q, options);
}

// The largest separation there is, and the factor that brings any two positions within it; to multiply by it
// is exact but for numbers that no distance of this size depends on.
inline constexpr double kMostSeparation = 0x1p1020, kNear = 0x1p-3;

inline PairMotion scaled(PairMotion motion, double factor) {
  for (auto* points : {&motion.t0, &motion.t1})
    for (Point& p : *points)
      for (double& x : p) x *= factor;
  return motion;
}

// Measures a pair where it stands: `gap` is its distance and `weights` its closest points, as Contact says of
// toi 0. `outcome` is non_finite or out_of_range where there are none, and free where the pair is farther
// apart than kMostSeparation.
inline QueryResult at_rest(const PairMotion& motion, Options options = {}) {
  options.min_separation = kMostSeparation;
  return ask({motion.kind, motion.t0, motion.t0, motion.vertex}, options);
}

// The distance of a pair, and the weights of its vertices whose sum is the vector between the closest points.
// NaN where positions are not usable.
struct Nearest {
  double distance = std::numeric_limits<double>::quiet_NaN();
  std::array<double, 4> weights{};
};
inline Nearest nearest(const PairMotion& pair) {
  QueryResult r = at_rest(pair);
  Nearest n;
  if (r.outcome == PairOutcome::non_finite || r.outcome == PairOutcome::out_of_range) return n;
  const bool far = r.outcome == PairOutcome::free;
  if (far) r = at_rest(scaled(pair, kNear));
  n.distance = far ? r.gap / kNear : r.gap;
  for (std::size_t i = 0; i < 4; ++i) n.weights[pair.vertex[i]] += r.weights[i];
  return n;
}

// Throws std::invalid_argument for what no query takes.
inline void require_limits(double min_distance, double tmax, double conservative_rescaling) {
  if (!(min_distance >= 0 && min_distance <= kMostSeparation))
    throw std::invalid_argument("min_distance is " + std::to_string(min_distance) + ", not in [0, 2^1020]");
  if (!(tmax >= 0 && tmax <= 1))
    throw std::invalid_argument("tmax is " + std::to_string(tmax) + ", not in [0, 1]");
  if (!(conservative_rescaling > 0 && conservative_rescaling <= 1))
    throw std::invalid_argument("conservative_rescaling is " + std::to_string(conservative_rescaling) +
                                ", not in (0, 1]");
}

// The share of a gap that is kept, in [0, 1): the largest number below 1 where it is nearer to 1. Out of
// range where conservative_rescaling is.
inline double kept_share(double conservative_rescaling) {
  double share = 0;
  in_default_float_environment([&] { share = 1 - conservative_rescaling; });
  return share == 1 && conservative_rescaling > 0 ? 1 - 0x1p-53 : share;
}

// The time of time_of_impact, up to 1, in the library's floating-point environment.
inline double first_time(const PairMotion& motion, double min_distance, double conservative_rescaling,
                         Options options) {
  options.min_separation = min_distance;
  const QueryResult start = at_rest(motion, options);
  const double gap = start.gap - min_distance;
  // What is rounded here moves the wider separation, and that stays min_distance at least: no contact with
  // min_distance comes before the one with the wider separation.
  options.min_separation = min_distance + (1 - conservative_rescaling) * std::max(gap, 0.0);
  if (start.outcome == PairOutcome::free || options.min_separation > kMostSeparation) {
    if (options.tolerance) *options.tolerance = std::max(*options.tolerance * kNear, 0x1p-1022);
    return first_time(scaled(motion, kNear), min_distance * kNear, conservative_rescaling, options);
  }
  const QueryResult kept = ask(motion, options);
  if (kept.toi > 0 || kept.outcome != PairOutcome::initial_separating) return kept.toi;
  // It starts within rounding of the wider separation, or within min_distance, and parts.
  options.min_separation = min_distance;
  const QueryResult plain = ask(motion, options);
  return std::min(kept.step_limit,
                  plain.outcome == PairOutcome::initial_separating ? plain.step_limit : plain.toi);
}

// Computes how far a pair may go: never later than the first time at which it comes as close as min_distance,
// by the exact motion. Infinite where it does not in [0, 1], and keeps 1 - conservative_rescaling, in [0, 1),
// of its gap beyond min_distance as well; 0 for positions that are not usable, and where the gap is too small
// to keep a share of. A pair that is within min_distance already, or beyond it by no more than rounding,
// apart, and parts, may go on as long as it comes no closer than it was (docs/steps.md).
//
// min_distance: model length, in [0, 2^1020]. options: tolerance, max_checks and exactness are used. Throws
// std::invalid_argument for values out of range, and for tmax outside of [0, 1]. What is later than tmax is
// infinite.
inline double time_of_impact(const PairMotion& motion, double min_distance, double tmax,
                             double conservative_rescaling, const Options& options) {
  require_limits(min_distance, tmax, conservative_rescaling);
  double toi = 0;
  in_default_float_environment(
      [&] { toi = first_time(motion, min_distance, conservative_rescaling, options); });
  return toi <= tmax ? toi : std::numeric_limits<double>::infinity();
}

// Options with a number of iterations that ipc-toolkit passes as the checks that one pair may cost. Its
// default, ten million, and -1 for no limit, stand for Onset's default: a query then ends within
// milliseconds, early rather than late.
inline Options options_of_iterations(long max_iterations, long default_iterations) {
  Options options;
  if (max_iterations != default_iterations && max_iterations != -1) options.max_checks = max_iterations;
  return options;
}

// Finishes a query as ipc-toolkit does: whether there is an impact, and when.
inline bool impact(double& toi, const PairMotion& motion, double min_distance, double tmax,
                   double conservative_rescaling, const Options& options) {
  toi = time_of_impact(motion, min_distance, tmax, conservative_rescaling, options);
  return toi <= tmax;
}

}  // namespace onset::compat
