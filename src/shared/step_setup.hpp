// What every call on a step sets up: the motion, its accuracy and the broad phase.
#pragma once

#include <memory>
#include <optional>

#include "base/clock.hpp"
#include "broadphase/broad_phase.hpp"
#include "onset/mesh.hpp"
#include "scene/motion/storing.hpp"
#include "scene/pairs/rest_limits.hpp"
#include "src/shared/budget.hpp"
#include "src/shared/checked_options.hpp"

namespace onset {

// Returns the input for boxes that overlap wherever two primitives come within their separation + margin. The
// margin changes with the motion; static primitives leave it to the others, so that their boxes can stay.
BroadPhaseInput broad_phase_input(const MeshData& mesh, const Motion& motion, const Options& options,
                                  double margin, double t_max, BoxTest test);

// How far boxes must reach in a call.
struct BoxReach {
  // The boxes of the whole step, for contacts of the exact motion and as the broad phase is made.
  BroadPhaseInput whole, tree;
  // rounding_of_distances(motion), where the use asks for it.
  double rounding = 0;
};

struct StepSetup {
  // What boxes must reach (docs/theory.md, 13.5):
  // - contacts: contacts of the exact motion.
  // - stored_step: also pairs that storing a position could close.
  // - candidates: such pairs too, by swept boxes, for a caller who keeps the list.
  // - close: all pairs within a distance.
  enum class Use { contacts, stored_step, candidates, close };

  Motion motion;
  // Null where the motion is not usable (motion.status) or no budget is left.
  std::shared_ptr<BroadPhase> broad;
  // The boxes of the whole step, for contacts of the exact motion (`whole`) and as `broad` was made (`tree`),
  // which may since have shrunk to t_max.
  std::optional<BroadPhaseInput> whole, tree;
  Accuracy accuracy;
  // What the shape at rest leaves of separations; null where it lowers none, or candidates alone are wanted.
  std::shared_ptr<const RestLimits> rest;
  // rounding_of_distances(motion), where the use asks for it.
  double rounding = 0;
  // How far beyond its separation a pair with checks left can be reported, a length of the model.
  double reach = 0;
  Clock clock;

  // Sets all this up and fills the statistics that are known before any pair is. No broad phase is made where
  // the budget is spent. With d_hat > 0, boxes reach as far as pairs of a distance set of d_hat, or of
  // `reach` if that is more, can be apart, with positions rounded to doubles. `looks` says what
  // will be done with the pairs.
  StepSetup(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1, const Options& options, Use use,
            Stats& stats, Budget& budget, double d_hat = 0, Looks looks = Looks::at_all);
  ~StepSetup();

  // Leaves the broad phase to the next call on the mesh.
  void give_back_broad();

 private:
  std::shared_ptr<BroadPhasePool> pool_;
  std::size_t slot_ = 0;
};

// Returns that for a motion of a mesh. reach: reported_within its accuracy.
BoxReach box_reach(const MeshData& mesh, const Motion& motion, const Options& options, StepSetup::Use use,
                   double reach, double d_hat);

}  // namespace onset
