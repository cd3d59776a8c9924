#include "src/shared/close_set.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/float_environment.hpp"
#include "base/text_stream.hpp"
#include "narrowphase/distance/closest_points.hpp"
#include "narrowphase/narrow_phase.hpp"
#include "narrowphase/plane/plane_decision.hpp"
#include "scene/motion/motion.hpp"
#include "scene/pair_source.hpp"
#include "scene/pairs/separation.hpp"
#include "src/planes/plane_blocks.hpp"
#include "src/shared/visit_pairs.hpp"

namespace onset {
namespace {

// Returns a bound of |w|_2 / |w| in the norm in use: sqrt(3), rounded up, for the maximum norm.
double norm_ratio(const Options& options) { return options.norm == Norm::maximum ? 0x1.bb67ae8584cabp+0 : 1; }

void check_reach(double d_hat, bool zero_allowed) {
  if ((zero_allowed ? d_hat >= 0 : d_hat > 0) && d_hat <= kMaxCoordinate) return;
  TextStream s;
  s << "d_hat is " << d_hat << "; it must be a number " << (zero_allowed ? ">= 0" : "> 0")
    << ", at most 2^1020";
  throw std::invalid_argument(s.str());
}

}  // namespace

double euclidean_separation(const Mesh& mesh, const Options& options, const RestLimits* rest,
                            const Pair& pair) {
  const MeshData& data = mesh.data();
  const double own =
      pair.kind == PairKind::vertex_plane
          ? separation_from_planes(data, options, pair.a)
          : separation_of_pair(data, options, rest, pair.kind, {pair.a, pair.b}, pair.vertices.data());
  const double ratio = norm_ratio(options);
  return ratio == 1 ? own : ratio * own * (1 + 0x1p-50);
}

ClosePair pair_with_plane(const Mesh& mesh, const Options& options, int vertex, int plane) {
  ClosePair p;
  static_cast<Pair&>(p) = {PairKind::vertex_plane, vertex, plane, {vertex, -1, -1, -1}};
  p.weights = {1, 0, 0, 0};
  p.separation = euclidean_separation(mesh, options, nullptr, p);
  return p;
}

double put_plane_distance(double distance, ClosePair& p) {
  const double gap = below_plane_distance(distance) - p.separation;
  p.distance = distance, p.gap = std::max(0.0, gap * (1 - 0x1p-52));
  return gap;
}

void check_d_hat(double d_hat, bool zero_allowed) { in_float_environment(check_reach, d_hat, zero_allowed); }

double euclidean_reach(const MeshData& mesh, const Options& options, double d_hat, double rounding) {
  const double ratio = norm_ratio(options);  // the thickness is added where a pair is looked at
  const double separation = ratio * largest_of_bodies(mesh, options) + (ratio - 1) * 2 * thickest(mesh);
  return (separation + d_hat + rounding) * (1 + 0x1p-48);
}

// No pair whose exact distance is at most its separation + d_hat is left out: `lower` is no larger, and
// rounding is monotone (docs/theory.md, 19).
void add_if_close(const CloseInput& in, PairKind kind, IdPair ids, std::vector<ClosePair>& close) {
  ClosePair p;
  static_cast<Pair&>(p) = {kind, ids.a, ids.b, pair_vertices(in.mesh.data(), kind, ids)};
  const double* x[4];
  for (std::size_t i = 0; i < 4; ++i) x[i] = in.x + 4 * std::size_t(p.vertices[i]);
  const auto same = [&](int i, int j) { return at_one_place(x[i], x[j]); };
  if (in.mesh.data().weld && any_across(points_of_first_side(kind), 4, same)) return;
  const ClosestPoints at = closest_points(kind, x);
  p.separation = euclidean_separation(in.mesh, in.options, in.rest, p);
  const double gap = at.lower - p.separation;
  if (gap > (in.d_hat + in.slack) * (1 + 0x1p-52)) return;
  std::copy(at.weights, at.weights + 4, p.weights.begin());
  p.distance = at.distance;
  p.gap = std::max(0.0, gap * (1 - 0x1p-52));
  close.push_back(p);
}

namespace {

// As add_if_close, after a cheap test. The distance is right to 2^-49, relatively.
void add_if_close_to_plane(const CloseInput& in, const PlaneBlock& block, int v,
                           std::vector<ClosePair>& close) {
  ClosePair p = pair_with_plane(in.mesh, in.options, v, block.row);
  const double* x = in.x + 4 * std::size_t(v);
  if (PlaneSpan(*block.plane, x, x).stays_beyond(*block.plane, p.separation + (in.d_hat + in.slack), 0))
    return;
  const double gap =
      put_plane_distance(start_at_plane(*block.plane, question_of(*block.plane, x, x, 0, false)).distance, p);
  if (gap <= (in.d_hat + in.slack) * (1 + 0x1p-52)) close.push_back(p);
}

}  // namespace

Gathered<ClosePair> find_close(const PairSource& candidates, const CloseInput& input, Budget& budget) {
  static_assert(sizeof(ClosePair) == 88, "as documented");
  const std::size_t most = std::size_t(input.options.memory_limit / std::int64_t(sizeof(ClosePair)));
  const auto ids_of = [](const ClosePair& p) { return IdPair{p.a, p.b}; };
  auto all = gather<ClosePair>(
      candidates, {kStepKinds.begin(), kStepKinds.end()}, most, budget,
      [&](PairKind kind, const IdPair* pairs, std::size_t count, std::vector<ClosePair>& close) {
        for (std::size_t i = 0; i < count; ++i) add_if_close(input, kind, pairs[i], close);
      },
      ids_of);
  gather_planes(
      PlaneBlocks(input.mesh.data(), input.axes, Norm::euclidean), most, budget,
      [&](const PlaneBlock& block, int v, std::vector<ClosePair>& close) {
        add_if_close_to_plane(input, block, v, close);
      },
      ids_of, all);
  if (budget.outcome() != Outcome::free || all.too_many) all.found = {};
  return all;
}

}  // namespace onset
