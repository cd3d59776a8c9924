#include "src/shared/rest/rest_limits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "broadphase/broad_phase.hpp"
#include "narrowphase/distance/closest_points.hpp"
#include "narrowphase/distance/maximum_norm.hpp"
#include "scene/motion/motion.hpp"
#include "src/shared/checked_options.hpp"
#include "src/shared/visit_pairs.hpp"

namespace onset {
namespace {

// Returns share times a lower bound of the distance, rounded down: the product and the factor err by 2^-53
// each, by half of the smallest number where it is subnormal.
double limit_of(double share, double lower) {
  const double r = share * lower * (1 - 0x1p-51);
  return std::max(0.0, r < 0x1p-1000 ? r - 0x1p-1073 : r);
}

// Returns how many pairs Options::memory_limit holds, at 12 bytes each.
std::size_t most_pairs(const Options& options) { return std::size_t(options.memory_limit) / 12; }

// Finds the limits below `reach` in one norm.
class RestSearch {
 public:
  RestSearch(const MeshData& mesh, const Options& options, double reach, Budget& budget)
      : mesh_(mesh),
        options_(options),
        reach_(reach),
        budget_(budget),
        motion_(make_motion(mesh.num_vertices, {mesh.rest->x.data(), mesh.num_vertices},
                            {mesh.rest->x.data(), mesh.num_vertices}, mesh.dimension == 2)) {}

  std::shared_ptr<const RestLimits> run() {
    // Every pair whose limit is below `reach` must be among the candidates, so that which ones are listed
    // does not depend on what earlier calls asked for. Its lower bound is below (reach + 2^-1072) / share (1
    // + 2^-49), and its distance no more than 64u rho beyond that (ClosestPoints; 48u in the maximum norm,
    // docs/theory.md, L44), where rho is at most 2 sqrt(3) times the largest coordinate: together 222u of it.
    BroadPhaseInput input{mesh_, motion_};
    const double beyond = 0x1p-44 * largest_coordinate() + 0x1p-1060;
    input.inflation =
        std::min(0.5 * ((reach_ + 0x1p-1060) / mesh_.rest->share + beyond) * (1 + 0x1p-48), 0x1p1022);
    input.test = BoxTest::swept;
    input.instruction_set = options_.instruction_set;
    const auto broad = make_broad_phase(options_.broad_phase, input, budget_.stop());
    if (!broad || budget_.spent()) return nullptr;
    std::array<std::vector<RestLimit>, kStepKinds.size()> limits;
    for (const PairKind kind : kStepKinds)
      if (has_kind(mesh_, kind)) limits[std::size_t(kind)] = find(*broad, kind);
    if (budget_.spent()) return nullptr;
    return std::make_shared<const RestLimits>(reach_, limits);
  }

 private:
  double largest_coordinate() const {
    double r = 0;
    for (const double x : mesh_.rest->x) r = std::max(r, std::fabs(x));
    return r;
  }

  std::vector<RestLimit> find(const PairSource& pairs, PairKind kind) {
    if (budget_.spent()) return {};
    const std::size_t most = most_pairs(options_);
    auto all = gather<RestLimit>(
        pairs, {kind}, most - std::min(most, kept_), budget_,
        [&](PairKind, const IdPair* batch, std::size_t count, std::vector<RestLimit>& found) {
          for (std::size_t i = 0; i < count; ++i)
            if (const double limit = limit_of(mesh_.rest->share, lower_bound(kind, batch[i])); limit < reach_)
              found.push_back({batch[i], limit});
        },
        [](const RestLimit& limit) { return limit.pair; });
    if (all.too_many) budget_.run_out_of_memory();
    kept_ += all.found.size();
    return std::move(all.found);
  }

  // Returns a lower bound of a pair's distance at rest, in the norm of the call.
  double lower_bound(PairKind kind, IdPair pair) const {
    const std::array<int, 4> v = pair_vertices(mesh_, kind, pair);
    const double* x[4];
    for (std::size_t i = 0; i < 4; ++i) x[i] = motion_.t0(v[i]);
    return options_.norm == Norm::maximum ? distance_below_in_maximum_norm(kind, x)
                                          : closest_points(kind, x).lower;
  }

  const MeshData& mesh_;
  const Options& options_;
  const double reach_;
  Budget& budget_;
  const Motion motion_;
  std::size_t kept_ = 0;
};

}  // namespace

std::shared_ptr<const RestLimits> rest_limits(const MeshData& mesh, const Options& options, Budget& budget) {
  if (!mesh.rest) return nullptr;
  const double reach = largest_separation(mesh, options);
  if (reach == 0) return nullptr;
  const std::size_t slot = std::size_t(options.norm);
  auto known = mesh.rest->limits.get(slot);
  if (known && known->reach() >= reach) {
    // As if they were found now, so that the answer does not depend on earlier calls.
    const bool limited = options.memory_limit < std::numeric_limits<std::int64_t>::max();
    if (!limited || known->count_below(reach) <= most_pairs(options)) return known;
    budget.run_out_of_memory();
    return nullptr;
  }
  known = RestSearch(mesh, options, reach, budget).run();
  if (known) mesh.rest->limits.put(known, slot);
  return known;
}

}  // namespace onset
