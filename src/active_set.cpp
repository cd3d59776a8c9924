#include "onset/active_set.hpp"

#include "base/parallel.hpp"
#include "src/shared/checked_options.hpp"
#include "src/shared/contacts.hpp"
#include "src/shared/find_contacts.hpp"

namespace onset {

ActiveSet construct_active_set(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1,
                               const Options& options) {
  check(options);
  ActiveSet set;
  set.dimension = mesh.dimension();
  in_arena(options.threads, [&] {
    Budget budget(options);
    StepSetup setup(mesh, x_t0, x_t1, options, StepSetup::Use::contacts, set.stats, budget, 0,
                    options.window < 1 ? Looks::at_earliest : Looks::at_all);
    set.outcome = setup.motion.status;
    set.vertex = setup.motion.bad_vertex;
    if (set.outcome != Outcome::free) return;
    set.planes = mesh.data().planes;
    TraversalResult traversal = find_contacts(mesh, setup, options, Collect::all, budget, set.stats);
    const double begun = setup.clock.seconds();
    note_worst(mesh, traversal, set.stats);
    cut_off(traversal.found, earliest_toi(traversal.found), options, budget.outcome(), set);
    fill_contacts(mesh, setup.motion, options, traversal.found, budget.interruption(), set);
    if (budget.outcome() != Outcome::free) {
      set.outcome = budget.outcome();
      set.complete_until = 0;
      set.stats.looked_at = budget.done();
    }
    if (set.size() > 0 && set.outcome == Outcome::free) set.outcome = Outcome::contact;
    set.stats.seconds_total = setup.clock.seconds();
    set.stats.seconds_contacts = set.stats.seconds_total - begun;
  });
  return set;
}

}  // namespace onset
