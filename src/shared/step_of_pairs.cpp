#include "scene/motion/extents.hpp"
#include "scene/motion/storing.hpp"
#include "src/shared/step_of_pairs.hpp"

#include "base/clock.hpp"
#include "base/instruction_set.hpp"
#include "base/parallel.hpp"
#include "src/shared/checked_options.hpp"
#include "src/shared/pair_traversal.hpp"

namespace onset {

StepResult step_of_pairs(const Mesh& mesh, const Motion& motion, const PairList& pairs, const Options& options,
                   double gap_share, Budget& budget, double upper) {
  StepResult r;
  const Clock clock;
  const MeshData& data = mesh.data();
  r.outcome = motion.status;
  r.vertex = motion.bad_vertex;
  r.stats.threads = current_threads();
  r.stats.instruction_set = to_string(resolve_instruction_set(options.instruction_set));
  r.stats.broad_phase = "listed";
  if (r.outcome != Outcome::free) return r;
  const Accuracy accuracy = accuracy_of(data, motion, options);
  note(accuracy, r.stats);
  const double rounding = rounding_of_distances(motion);
  const NarrowPhase narrow(stored_step_input(data, motion, accuracy, options, gap_share, rounding));
  const TraversalResult traversal = traverse_pairs(pairs, narrow, Collect::first, 1, budget);
  copy_counts(traversal, r.stats);
  limit_step(mesh, traversal, budget, upper, 1, r);
  r.rounding = reported_rounding(rounding);
  r.stats.seconds_narrow = clock.seconds();
  return r;
}

}  // namespace onset
