// What every call sets up: the motion, its accuracy and the broad phase.
#pragma once

#include <memory>
#include <optional>

#include "broadphase/broad_phase.hpp"
#include "onset/mesh.hpp"
#include "src/budget.hpp"
#include "src/clock.hpp"

namespace onset {

// Boxes of two primitives overlap wherever these come within min_separation + margin, thickness apart. The
// margin changes with the motion; static primitives leave it to the others, so that their boxes can stay.
BroadPhaseInput broad_phase_input(const MeshData& mesh, const Motion& motion, const Options& options,
                                  double margin, double horizon, BoxTest test);

struct Scene {
  Motion motion;
  std::shared_ptr<BroadPhase>
      broad;  // empty where the motion is not usable (motion.status), or no budget is left
  // The candidates of the whole step; `broad` may since have shrunk to a horizon.
  std::optional<BroadPhaseInput> whole;
  Clock clock;

  // `test`: swept, or motion: passing then where that is cheaper.
  // Fills the statistics that are known before any pair is. No broad phase is made where the budget is spent.
  // d_hat >= 0: boxes reach as far as pairs of a distance set of d_hat, and at least of the tolerance, can be
  // apart, positions rounded to doubles included.
  Scene(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1, const Options& options, BoxTest test,
        Stats& stats, Budget& budget, double d_hat = -1);
  ~Scene();

  // Leaves the broad phase to the next call on the mesh.
  void give_back_broad();

 private:
  std::shared_ptr<Spares> spares_;
  std::size_t slot_ = 0;
};

}  // namespace onset
