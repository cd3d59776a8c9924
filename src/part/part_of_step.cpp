#include "src/part/part_of_step.hpp"

#include <algorithm>

#include "base/parallel.hpp"
#include "narrowphase/narrow_phase.hpp"
#include "scene/pairs/whole_scene.hpp"
#include "src/shared/checked_options.hpp"
#include "src/shared/contacts.hpp"
#include "src/shared/find_contacts.hpp"

namespace onset {

struct PartOfStep::Impl {
  Mesh mesh;
  const Options& options;
  const Collect collect;
  Stats stats;
  Budget budget;
  StepSetup setup;
  TraversalResult traversal;

  Impl(const Mesh& of, const Positions& x_t0, const Positions& x_t1, const Options& o, Collect wanted)
      : mesh(of),
        options(o),
        collect(wanted),
        budget(o),
        setup(of, x_t0, x_t1, o,
              wanted == Collect::first ? StepSetup::Use::stored_step : StepSetup::Use::contacts, stats,
              budget, 0, wanted == Collect::any ? Looks::at_any : Looks::at_all) {}
};

PartOfStep::PartOfStep(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1, const Options& options,
                       Collect collect) {
  check(options);
  in_arena(options.threads, [&] { impl_ = std::make_unique<Impl>(mesh, x_t0, x_t1, options, collect); });
}

void PartOfStep::find() {
  Impl& h = *impl_;
  in_arena(h.options.threads, [&] {
    if (h.setup.motion.status != Outcome::free) return;
    h.traversal = find_contacts(h.mesh, h.setup, h.options, h.collect, h.budget, h.stats);
    note_worst(h.mesh, h.traversal, h.stats);
    if (h.budget.outcome() != Outcome::free) h.stats.looked_at = h.budget.done();
    h.stats.seconds_total = h.setup.clock.seconds();
  });
}
PartOfStep::~PartOfStep() = default;

Outcome PartOfStep::outcome() const { return impl_->budget.outcome(); }
const Limits& PartOfStep::limits() const { return impl_->traversal.limits; }
const Stats& PartOfStep::stats() const { return impl_->stats; }
double PartOfStep::rounding() const { return impl_->setup.rounding; }

double PartOfStep::least_toi_hi() const { return onset::least_toi_hi(impl_->traversal.found); }

void PartOfStep::sharpen(double latest) {
  Impl& h = *impl_;
  in_arena(h.options.threads,
           [&] { sharpen_earliest(h.mesh, h.setup, h.options, latest, h.traversal.found, h.budget); });
}

double PartOfStep::earliest() const { return earliest_toi(impl_->traversal.found); }

ActiveSet PartOfStep::contacts(double earliest) {
  Impl& h = *impl_;
  ActiveSet set;
  in_arena(h.options.threads, [&] {
    set.dimension = h.mesh.dimension();
    set.planes = h.mesh.data().planes;
    const double begun = h.setup.clock.seconds();
    cut_off(h.traversal.found, earliest, h.options, h.budget.outcome(), set);
    set.stats = h.stats;
    fill_contacts(h.mesh, h.setup.motion, h.options, h.traversal.found, h.budget.interruption(), set);
    if (h.budget.outcome() != Outcome::free) set.outcome = h.budget.outcome(), set.complete_until = 0;
    if (set.size() > 0 && set.outcome == Outcome::free) set.outcome = Outcome::contact;
    set.stats.seconds_total = h.setup.clock.seconds();
    set.stats.seconds_contacts = set.stats.seconds_total - begun;
  });
  return set;
}

double largest_inflation(const MeshData& mesh, const Options& options, StepSetup::Use use, double d_hat) {
  Motion none;
  none.axes = mesh.whole->axes;
  none.largest_elsewhere = mesh.whole->largest_coordinate;
  const Accuracy accuracy = accuracy_of(mesh, none, options);
  const double reach = reported_within(accuracy.tolerance, accuracy.extent);
  const BoxReach boxes = box_reach(mesh, none, options, use, reach, d_hat);
  return std::max({boxes.tree.inflation, boxes.tree.static_inflation, boxes.whole.inflation});
}

}  // namespace onset
