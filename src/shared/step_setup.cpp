#include "src/shared/step_setup.hpp"

#include <algorithm>
#include <utility>

#include "base/instruction_set.hpp"
#include "base/parallel.hpp"
#include "broadphase/held/holding_tree.hpp"
#include "narrowphase/narrow_phase.hpp"
#include "scene/motion/extents.hpp"
#include "scene/motion/storing.hpp"
#include "scene/pairs/separation.hpp"
#include "src/shared/checked_options.hpp"
#include "src/shared/close_set.hpp"
#include "src/shared/rest/rest_limits.hpp"

namespace onset {

BroadPhaseInput broad_phase_input(const MeshData& mesh, const Motion& motion, const Options& options,
                                  double margin, double t_max, BoxTest test) {
  const double separation = largest_of_bodies(mesh, options), half = 0.5 * separation * (1 + 0x1p-50);
  const bool has_static = scene_has_static(mesh);
  const double inflation =
      has_static ? (half + margin) * (1 + 0x1p-50) : 0.5 * (separation + margin) * (1 + 0x1p-50);
  return {mesh, motion, inflation, t_max, test, options.instruction_set, half};
}

namespace {

// Only trees and grids are worth keeping, those of swept boxes apart from those of motion boxes.
bool is_kept(BroadPhaseMethod method) { return method != BroadPhaseMethod::brute; }
std::size_t slot_of(BroadPhaseMethod method, BoxTest test) {
  return 2 * std::size_t(method == BroadPhaseMethod::hash) + std::size_t(test == BoxTest::swept);
}

// Takes the broad phase that an earlier call left, where its order will do, else makes one; null where the
// budget ends that. Under a budget of checks what is found depends on the order, which must then not depend
// on earlier calls.
std::shared_ptr<BroadPhase> take_broad_phase(const Options& options, const BroadPhaseInput& input,
                                             Budget& budget) {
  if (input.mesh.broad_phases && is_kept(options.broad_phase) && !budget.counts_checks()) {
    auto used = input.mesh.broad_phases->take(slot_of(options.broad_phase, input.test));
    if (used && used->suits(input.motion)) {
      used->refit(input, budget.stop());
      return used;
    }
  }
  const bool tree =
      options.broad_phase == BroadPhaseMethod::automatic || options.broad_phase == BroadPhaseMethod::bvh;
  // What a part decides is sorted out behind a tree, which make_broad_phase sees to.
  if (tree && input.mesh.broad_phases && !input.mesh.whole) return make_holding_tree(input, budget.stop());
  return make_broad_phase(options.broad_phase, input, budget.stop());
}

// Eight a primitive are few enough beside its boxes, and more than most scenes have.
std::size_t most_held(const MeshData& mesh, const Options& options, const Budget& budget) {
  if (!options.hold_candidates || budget.counts_checks() || !mesh.broad_phases || mesh.whole) return 0;
  constexpr std::size_t kAPrimitive = 8;
  const std::size_t primitives = std::size_t(mesh.num_vertices) + mesh.edges.size() + mesh.faces.size();
  const auto fitting = std::size_t(options.memory_limit) / sizeof(IdPair);
  return std::min(kAPrimitive * primitives, fitting);
}

}  // namespace

void StepSetup::give_back_broad() {
  if (broad && pool_) pool_->put(std::move(broad), slot_);
  broad.reset();
}

StepSetup::~StepSetup() {
  give_back_broad();
  if (motion.rows_last) motion.static_part->give_back(motion.axes, std::move(motion.x));
}

BoxReach box_reach(const MeshData& data, const Motion& motion, const Options& options, StepSetup::Use use,
                   double reach, double d_hat) {
  using Use = StepSetup::Use;
  const BoxTest test = use == Use::candidates ? BoxTest::swept : cheaper_box_test(data, motion);
  // Boxes widened for a separation round, depending on where the scene lies. With this margin, boxes that
  // just miss belong to pairs farther apart than any that is reported with checks left, so that results do
  // not depend on that rounding (docs/theory.md, 13.5).
  const bool widened = largest_of_bodies(data, options) > 0 || has_thickness(data);
  const double margin = test != BoxTest::swept && widened ? reach : 0;
  const BroadPhaseInput whole = broad_phase_input(data, motion, options, margin, 1.0, test);
  BoxReach r{whole, whole};
  const auto widen = [&](double by) {
    r.tree.inflation = (r.tree.inflation + std::max(by, 0.0)) * (1 + 0x1p-50);
  };
  // Static boxes are not widened by it: the others take all.
  const double share = scene_has_static(data) ? 1 : 0.5;
  if (use != Use::contacts) r.rounding = rounding_of_distances(motion);
  if (use == Use::stored_step) widen(share * (reach + kStoredRoundings * r.rounding - margin));
  if (use == Use::candidates) widen(share * r.rounding);
  if (use == Use::close || d_hat > 0)
    r.tree.inflation = std::max(r.tree.inflation,
                                share * euclidean_reach(data, options, std::max(d_hat, reach), r.rounding));
  return r;
}

StepSetup::StepSetup(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1, const Options& options,
                     Use use, Stats& stats, Budget& budget, double d_hat, Looks looks) {
  const MeshData& data = mesh.data();
  motion = make_motion(data, x_t0, x_t1);
  stats.filter_counts = data.filter->counts;
  stats.threads = current_threads();
  stats.instruction_set = to_string(resolve_instruction_set(options.instruction_set));
  if (motion.status != Outcome::free) return;
  accuracy = accuracy_of(data, motion, options);
  note(accuracy, stats);
  reach = reported_within(accuracy.tolerance, accuracy.extent);
  const BoxReach boxes = box_reach(data, motion, options, use, reach, d_hat);
  whole.emplace(boxes.whole);
  tree.emplace(boxes.tree);
  // With this margin what diagonals drop is farther apart than any pair that is reported with checks left. A
  // step, or a search for any contact, looks at few pairs, for which making records costs more than they
  // spare: it asks at a contact.
  whole->diagonals = {use == Use::contacts || use == Use::stored_step, options.norm, reach};
  if (use == Use::contacts && looks != Looks::at_any) tree->diagonals = whole->diagonals;
  tree->looks = looks;
  tree->most_held = most_held(data, options, budget);
  rounding = boxes.rounding;
  if (use != Use::candidates) rest = rest_limits(data, options, budget);
  if (budget.spent()) return;
  broad = take_broad_phase(options, *tree, budget);
  if (!broad) return;
  if (is_kept(options.broad_phase)) pool_ = data.broad_phases;
  slot_ = slot_of(options.broad_phase, tree->test);
  stats.broad_phase = broad->name();
  stats.made_static_boxes = broad->made_static_boxes();
  stats.seconds_broad = clock.seconds();
}

}  // namespace onset
