// What every call sets up: the motion, its accuracy and the broad phase.
#pragma once

#include <memory>
#include <optional>

#include "base/clock.hpp"
#include "broadphase/broad_phase.hpp"
#include "onset/mesh.hpp"
#include "src/shared/budget.hpp"

namespace onset {

// Boxes of two primitives overlap wherever these come within min_separation + margin, thickness apart. The
// margin changes with the motion; static primitives leave it to the others, so that their boxes can stay.
BroadPhaseInput broad_phase_input(const MeshData& mesh, const Motion& motion, const Options& options,
                                  double margin, double t_max, BoxTest test);

struct Scene {
  // contacts: pairs of the exact motion. stored_step: also pairs that storing a position could close. candidates: the swept boxes of
  // these, for a caller who keeps them. close: as contacts, out to a distance.
  enum class Use { contacts, stored_step, candidates, close };

  Motion motion;
  std::shared_ptr<BroadPhase>
      broad;  // empty where the motion is not usable (motion.status), or no budget is left
  // The candidates of the whole step for contacts of the exact motion, and those that `broad` was made for; it may since have
  // shrunk to t_max.
  std::optional<BroadPhaseInput> whole, tree;
  double rounding = 0;  // rounding_of_distances(motion), where the use asks for it
  double reach = 0;     // model length: how far beyond what it must keep a pair can be reported that has checks left
  Clock clock;

  // Fills the statistics that are known before any pair is. No broad phase is made where the budget is spent.
  // d_hat > 0: boxes reach as far as pairs of a distance set of d_hat, and at least of the tolerance, can be
  // apart, positions rounded to doubles included.
  Scene(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1, const Options& options, Use use, Stats& stats,
        Budget& budget, double d_hat = 0);
  ~Scene();

  // Leaves the broad phase to the next call on the mesh.
  void give_back_broad();

 private:
  void widen(double by);

  std::shared_ptr<BroadPhasePool> pool_;
  std::size_t slot_ = 0;
};

}  // namespace onset
