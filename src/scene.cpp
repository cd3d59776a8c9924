#include "src/scene.hpp"

#include <algorithm>

#include "base/dispatch.hpp"
#include "base/parallel.hpp"
#include "src/checked_options.hpp"
#include "src/close_set.hpp"

namespace onset {

Scene::Scene(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1, const Options& options,
             BoxTest test, Stats& stats, Budget& budget, double d_hat) {
  const MeshData& data = mesh.data();
  motion = make_motion(data.num_vertices, x_t0, x_t1);
  stats.threads = current_threads();
  stats.kernel = kernel_name(resolve_kernel(options.kernel));
  if (motion.status != Outcome::free) return;
  describe_accuracy(motion, corner_extents(data, motion, largest_separation(data, options)), options, stats);
  // With a separation, widened boxes round, and by how much depends on where the scene lies. Wider by the
  // tolerance, boxes that just miss belong to pairs farther apart than any that is reported: results do not
  // depend on that rounding.
  const bool widened = options.min_separation > 0 || !data.thickness.empty();
  const double margin = test == BoxTest::motion && widened ? stats.tolerance : 0;
  double inflation = 0.5 * (options.min_separation + margin) * (1 + 0x1p-50);
  if (d_hat >= 0) {
    const double near = std::max(d_hat, stats.tolerance);
    inflation =
        std::max(inflation, 0.5 * euclidean_reach(data, options, near, rounding_of_distances(motion)));
  }
  if (budget.spent()) return;
  broad = make_broad_phase(options.broad_phase, {data, motion, inflation, 1.0, test, options.kernel});
  stats.broad_phase = broad->name();
  stats.seconds_broad = clock.seconds();
}

}  // namespace onset
