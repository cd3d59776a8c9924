#include "src/truncate/motion_limits.hpp"

#include "narrowphase/exact/exact.hpp"
#include "scene/pairs/separation.hpp"
#include "scene/primitive.hpp"

namespace onset {
namespace {

struct Input {
  const Mesh& mesh;
  const Motion& motion;
  const TruncateOptions& options;
  const RestLimits* rest;
};

double separation_of(const Input& in, const Pair& pair) {
  return separation_of_pair(in.mesh.data(), in.options, in.rest, pair.kind, {pair.a, pair.b},
                            pair.vertices.data());
}

void add_if_limiting(const Input& in, PairKind kind, IdPair ids, std::vector<MotionLimit>& found) {
  MotionLimit limit{};
  limit.pair = {kind, ids.a, ids.b, pair_vertices(in.mesh.data(), kind, ids)};
  if (in.mesh.data().weld && is_seam(in.motion, kind, limit.pair.vertices)) return;
  const double *x0[4], *x1[4];
  for (std::size_t i = 0; i < 4; ++i)
    x0[i] = in.motion.t0(limit.pair.vertices[i]), x1[i] = in.motion.t1(limit.pair.vertices[i]);
  const Demand demand{separation_of(in, limit.pair), in.options.norm == Norm::maximum, in.options.gap_share};
  const Division division = divide(kind, x0, x1, demand, limit.plane);
  if (division == Division::free) return;
  limit.has_plane = division == Division::divided;
  limit.touches =
      !limit.has_plane && exactly_touches({kind, {x0[0], x0[1], x0[2], x0[3]}, {x0[0], x0[1], x0[2], x0[3]}});
  found.push_back(limit);
}

}  // namespace

Gathered<MotionLimit> find_limits(const Mesh& mesh, const Motion& motion, const PairSource& candidates,
                                  const TruncateOptions& options, const RestLimits* rest, Budget& budget) {
  static_assert(sizeof(MotionLimit) == 104, "as documented");
  const Input input{mesh, motion, options, rest};
  auto all = gather<MotionLimit>(
      candidates, {kStepKinds.begin(), kStepKinds.end()},
      std::size_t(options.memory_limit / std::int64_t(sizeof(MotionLimit))), budget,
      [&](PairKind kind, const IdPair* pairs, std::size_t count, std::vector<MotionLimit>& found) {
        for (std::size_t i = 0; i < count; ++i) add_if_limiting(input, kind, pairs[i], found);
      },
      [](const MotionLimit& limit) {
        return IdPair{limit.pair.a, limit.pair.b};
      });
  if (budget.outcome() != Outcome::free) all.found = {};
  return all;
}

}  // namespace onset
