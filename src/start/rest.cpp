#include "src/start/rest.hpp"

#include <utility>

#include "scene/pairs/separation.hpp"

namespace onset {

// Leaves the rows of static vertices to the next call on the mesh.
Rest::~Rest() {
  if (motion.rows_last) motion.static_part->give_back(motion.axes, std::move(motion.x));
}

void Rest::find(const Mesh& mesh, Pairs pairs, const Options& options, Budget& budget) {
  if (motion.status != Outcome::free || budget.spent()) return;
  const bool edge_face = pairs == Pairs::edge_face;
  BroadPhaseInput input{mesh.data(), motion};
  // Half of the separation, rounded up. The last term keeps half of the smallest number from being 0.
  const double separation = largest_of_bodies(mesh.data(), options);
  if (!edge_face && separation > 0) input.inflation = 0.5 * separation * (1 + 0x1p-50) + 0x1p-1074;
  input.test = BoxTest::swept;
  input.instruction_set = options.instruction_set;
  input.intersections = edge_face;
  broad = make_broad_phase(options.broad_phase, input, budget.stop());
}

}  // namespace onset
