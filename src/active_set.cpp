#include "onset/active_set.hpp"

#include <algorithm>
#include <limits>

#include "base/parallel.hpp"
#include "src/shared/checked_options.hpp"
#include "src/shared/contacts.hpp"
#include "src/shared/find_contacts.hpp"

namespace onset {
namespace {

// Cuts off what the window and the memory limit exclude, in the order (toi, kind, a, b).
void cut_off(std::vector<FoundPair>& found, const Options& options, Budget& budget, ActiveSet& set) {
  set.complete_until = std::numeric_limits<double>::infinity();
  set.outcome = budget.outcome();
  if (!found.empty() && options.window < 1) {
    double earliest = found[0].result.toi;
    for (const FoundPair& f : found) earliest = std::min(earliest, f.result.toi);
    set.complete_until = earliest + options.window;
    found.erase(std::remove_if(found.begin(), found.end(),
                               [&](const FoundPair& f) { return f.result.toi > set.complete_until; }),
                found.end());
  }
  if (found.size() > most_contacts(options)) {  // by one, which says until when the others are all
    const auto latest = std::max_element(found.begin(), found.end(), earlier);
    set.complete_until = latest->result.toi;
    if (set.outcome == Outcome::free) set.outcome = Outcome::out_of_memory;
    found.erase(latest);
  }
}

}  // namespace

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
    cut_off(traversal.found, options, budget, set);
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
