#include "onset/close_pairs.hpp"

#include "base/parallel.hpp"
#include "src/shared/checked_options.hpp"
#include "src/shared/close_set.hpp"
#include "src/shared/step_setup.hpp"

namespace onset {

ClosePairs close_pairs(const Mesh& mesh, const Positions& x, double d_hat, const Options& options) {
  check(options);
  check_d_hat(d_hat, false);
  ClosePairs r;
  r.d_hat = d_hat;
  in_arena(options.threads, [&] {
    Stats stats;
    Budget budget(options);
    const StepSetup setup(mesh, x, x, options, StepSetup::Use::close, stats, budget, d_hat);
    r.outcome = setup.motion.status;
    r.vertex = setup.motion.bad_vertex;
    if (r.outcome == Outcome::free && !setup.broad) r.outcome = budget.outcome();
    if (r.outcome != Outcome::free) return;
    static_assert(kMotionStride == 8, "a vertex's two ends are four doubles each");
    std::vector<double> at(std::size_t(mesh.num_vertices()) * 4);
    for (int v = 0; v < setup.motion.num_vertices; ++v)
      for (int a = 0; a < 3; ++a) at[std::size_t(4 * v + a)] = setup.motion.t0(v)[a];
    auto close = find_close(
        *setup.broad, {mesh, at.data(), d_hat, 0, options, setup.motion.axes, setup.rest.get()}, budget);
    r.pairs = std::move(close.found);
    r.outcome = close.too_many ? Outcome::out_of_memory : budget.outcome();
    r.seconds = setup.clock.seconds();
  });
  return r;
}

}  // namespace onset
