#include "src/shared/step_setup.hpp"

#include <algorithm>
#include <utility>

#include "base/instruction_set.hpp"
#include "base/parallel.hpp"
#include "narrowphase/narrow_phase.hpp"
#include "src/shared/checked_options.hpp"
#include "src/shared/close_set.hpp"

namespace onset {

BroadPhaseInput broad_phase_input(const MeshData& mesh, const Motion& motion, const Options& options,
                                  double margin, double t_max, BoxTest test) {
  const double half = 0.5 * options.min_separation * (1 + 0x1p-50);
  const bool has_static = mesh.filter->has_static();
  const double inflation =
      has_static ? (half + margin) * (1 + 0x1p-50) : 0.5 * (options.min_separation + margin) * (1 + 0x1p-50);
  return {mesh, motion, inflation, t_max, test, options.instruction_set, half};
}

namespace {

// Only trees and grids are worth keeping: swept and motion boxes in slots of their own.
bool is_kept(BroadPhaseMethod method) { return method != BroadPhaseMethod::brute; }
std::size_t slot_of(BroadPhaseMethod method, BoxTest test) {
  return 2 * std::size_t(method == BroadPhaseMethod::hash) + std::size_t(test == BoxTest::swept);
}

// The one that an earlier call left, where its order will do. Under a budget of checks what is found depends
// on the order: it must not depend on earlier calls.
std::shared_ptr<BroadPhase> take_broad_phase(const Options& options, const BroadPhaseInput& input,
                                             const Budget& budget) {
  if (input.mesh.broad_phases && is_kept(options.broad_phase) && !budget.counts_checks()) {
    auto used = input.mesh.broad_phases->take(slot_of(options.broad_phase, input.test));
    if (used && used->suits(input.motion)) {
      used->refit(input);
      return used;
    }
  }
  return make_broad_phase(options.broad_phase, input);
}

}  // namespace

void Scene::give_back_broad() {
  if (broad && pool_) pool_->give_back(slot_, std::move(broad));
  broad.reset();
}

Scene::~Scene() {
  give_back_broad();
  if (motion.rows_last) motion.static_part->give_back(motion.axes, std::move(motion.x));
}

void Scene::widen(double by) { tree->inflation = (tree->inflation + std::max(by, 0.0)) * (1 + 0x1p-50); }

Scene::Scene(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1, const Options& options, Use use,
             Stats& stats, Budget& budget, double d_hat) {
  const MeshData& data = mesh.data();
  motion = make_motion(data, x_t0, x_t1);
  stats.filter_counts = data.filter->counts;
  stats.threads = current_threads();
  stats.instruction_set = to_string(resolve_instruction_set(options.instruction_set));
  if (motion.status != Outcome::free) return;
  const BoxTest test = use == Use::candidates ? BoxTest::swept : cheaper_box_test(data, motion);
  describe_accuracy(motion, corner_extents(data, motion, largest_separation(data, options)), options, stats);
  reach = reported_within(stats.tolerance, stats.extent);
  // With a separation, widened boxes round, and by how much depends on where the scene lies. Wider by the
  // tolerance, boxes that just miss belong to pairs farther apart than any that is reported, unless it spends
  // its checks: results do not depend on that rounding.
  const bool widened = options.min_separation > 0 || !data.thickness.empty();
  const double margin = test != BoxTest::swept && widened ? reach : 0;
  whole.emplace(broad_phase_input(data, motion, options, margin, 1.0, test));
  tree.emplace(*whole);
  const bool has_static = data.filter->has_static();
  const double share = has_static ? 1 : 0.5;  // boxes that are static are not widened: the others take all of it
  if (use != Use::contacts) rounding = rounding_of_distances(motion);
  if (use == Use::stored_step) widen(share * (reach + kStoredRoundings * rounding - margin));
  if (use == Use::candidates) widen(share * rounding);
  if (use == Use::close || d_hat > 0)
    tree->inflation =
        std::max(tree->inflation, share * euclidean_reach(data, options, std::max(d_hat, reach), rounding));
  if (budget.spent()) return;
  broad = take_broad_phase(options, *tree, budget);
  if (is_kept(options.broad_phase)) pool_ = data.broad_phases;
  slot_ = slot_of(options.broad_phase, test);
  stats.broad_phase = broad->name();
  stats.made_static_boxes = broad->made_static_boxes();
  stats.seconds_broad = clock.seconds();
}

}  // namespace onset
