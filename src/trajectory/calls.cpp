// The calls on trajectories: what is linear goes through the linear pipeline, the rest in pieces of time.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <utility>

#include "base/parallel.hpp"
#include "onset/trajectory.hpp"
#include "scene/motion/storing.hpp"
#include "src/shared/checked_options.hpp"
#include "src/shared/contacts.hpp"
#include "src/shared/find_contacts.hpp"
#include "src/shared/found_pairs.hpp"
#include "src/trajectory/refinement.hpp"
#include "src/trajectory/turning_scene.hpp"

namespace onset {
namespace {

bool before(const Contact& x, const Contact& y) {
  return order_of(x.kind, {x.a, x.b}) < order_of(y.kind, {y.a, y.b});
}
bool before_in_step(const Contact& x, const Contact& y) {
  return x.toi != y.toi ? x.toi < y.toi : before(x, y);
}

void check_rules(const MeshData& mesh) {
  const auto reject = [](const char* rule) {
    throw std::invalid_argument(std::string(rule) + " are not supported where a vertex turns");
  };
  if (!mesh.planes.empty()) reject("planes");
  if (!mesh.body_separations.empty()) reject("body_separations");
  if (mesh.rest) reject("rest_positions");
}

// What a call on a trajectory works with.
class Call {
 public:
  Call(const Mesh& mesh, const Trajectory& trajectory, const Options& options, Budget& budget)
      : mesh_(mesh), trajectory_(trajectory), options_(options), budget_(budget) {
    std::vector<int> bodies = bodies_of(mesh, trajectory);
    if (mesh.dimension() == 2)
      throw std::invalid_argument("the mesh is in the plane: trajectories have three coordinates");
    std::vector<int> all(bodies.size());
    for (std::size_t v = 0; v < all.size(); ++v) all[v] = int(v);
    turns_ = std::any_of(bodies.begin(), bodies.end(), [](int b) { return b != Trajectory::kLinear; });
    if (turns_ && options.touching_may_pass_through)
      throw std::invalid_argument("touching_may_pass_through is not supported where a vertex turns");
    if (turns_) check_rules(mesh.data());
    for (std::vector<double>* x : {&x0_, &x1_}) {
      x->resize(3 * all.size());
      trajectory.positions(x == &x0_ ? 0 : 1, all.data(), all.size(), x->data());
    }
    if (turns_) scene_ = take_turning_scene(mesh, std::move(bodies));
  }
  ~Call() {
    if (scene_) give_back(mesh_, std::move(scene_));
  }
  Call(const Call&) = delete;
  Call& operator=(const Call&) = delete;

  StepResult step(Collect collect);
  ActiveSet active_set();

 private:
  Positions at(const std::vector<double>& x) const { return {x.data(), std::ptrdiff_t(x.size() / 3)}; }
  TurningAnswer turning(Collect collect, double until) {
    return refine({mesh_, *scene_, trajectory_, x0_, x1_, options_, collect, until}, budget_);
  }
  std::vector<FoundPair> in_bodies(Stats& stats);
  std::vector<FoundPair> within_separation(const std::vector<double>& thickness, Stats& stats);
  void add_turning(ActiveSet& set);

  const Mesh& mesh_;
  const Trajectory& trajectory_;
  const Options& options_;
  Budget& budget_;
  bool turns_;
  std::vector<double> x0_, x1_;
  std::shared_ptr<TurningScene> scene_;
};

void add(const PairCounts& from, PairCounts& to) {
  to.vertex_face += from.vertex_face, to.edge_edge += from.edge_edge;
}

// Adds the counts of another part of a call; its times are in the total.
void add(const Stats& from, Stats& to) {
  add(from.candidates, to.candidates), add(from.after_culls, to.after_culls);
  add(from.inclusion, to.inclusion), add(from.gave_up, to.gave_up), add(from.contacts, to.contacts);
  to.checks += from.checks;
  if (from.max_checks_of_a_pair > to.max_checks_of_a_pair)
    to.max_checks_of_a_pair = from.max_checks_of_a_pair, to.worst = from.worst;
  for (std::size_t k = 0; k < to.checks_histogram.size(); ++k)
    to.checks_histogram[k] += from.checks_histogram[k];
  to.tolerance = std::max(to.tolerance, from.tolerance), to.extent = std::max(to.extent, from.extent);
  to.achieved_tolerance = std::max(to.achieved_tolerance, from.achieved_tolerance);
}

Stats stats_of(const Mesh& mesh, const TurningAnswer& answer) {
  Stats stats;
  copy_counts(answer.counts, stats);
  note_worst(mesh, answer.counts, stats);
  stats.contacts = {};
  for (const Contact& c : answer.contacts) {
    ++count_of(c.kind, stats.contacts);
    stats.achieved_tolerance = std::max(stats.achieved_tolerance, c.tolerance);
  }
  stats.tolerance = answer.tolerance, stats.extent = answer.extent;
  return stats;
}

bool is_of_one_body(const void* scene, PairKind kind, IdPair pair) {
  return static_cast<const TurningScene*>(scene)->is_of_one_body(kind, pair);
}

// Pairs within a rigid body that start within their separation, of a mesh with this thickness: others take
// none of their memory. Of more than it has room for, the first ones.
std::vector<FoundPair> Call::within_separation(const std::vector<double>& thickness, Stats& stats) {
  scene_->rest_data->thickness = thickness;
  Options options = options_;
  options.window = INFINITY;
  Stats of_these;
  StepSetup setup(scene_->rest, at(x0_), at(x0_), options, StepSetup::Use::contacts, of_these, budget_);
  const PairPredicate within{scene_.get(), is_of_one_body};
  TraversalResult traversal =
      find_contacts(scene_->rest, setup, options, Collect::all, budget_, of_these, &within);
  for (FoundPair& f : traversal.found)
    f.result.toi = f.result.step_limit = 0, f.result.outcome = PairOutcome::initial_contact;
  of_these.contacts = {};
  add(of_these, stats);
  return std::move(traversal.found);
}

// Pairs within a rigid body stay as far apart as they are, but for the rounding of what is stored: those that
// are a contact are one at once, and so are those that rounding may make one (docs/trajectories.md, S5).
std::vector<FoundPair> Call::in_bodies(Stats& stats) {
  if (!scene_->has_rest) return {};
  const auto widened = scene_->widened_at_rest(trajectory_);
  if (!widened) return {};  // the refinement says why
  std::vector<FoundPair> near = within_separation(*widened, stats);
  if (near.empty() || budget_.outcome() != Outcome::free) return {};
  for (FoundPair& f : near) {
    f.result.outcome = PairOutcome::below_rounding, f.result.certainty = Certainty::within_tolerance;
    f.result.toi_hi = INFINITY;
  }
  const std::vector<FoundPair> contacts = within_separation(scene_->thickness, stats);
  std::vector<FoundPair> both;  // what is in both, as a contact
  std::set_union(contacts.begin(), contacts.end(), near.begin(), near.end(), std::back_inserter(both),
                 [](const FoundPair& x, const FoundPair& y) { return before(x, y); });
  return both;
}

Outcome outcome_of(const Contact& contact) {
  if (contact.outcome == PairOutcome::below_rounding) return Outcome::below_rounding;
  if (contact.outcome == PairOutcome::max_checks)
    return contact.toi > 0 ? Outcome::max_checks : Outcome::below_rounding;
  return contact.toi > 0 ? Outcome::contact : Outcome::initial_contact;
}

// Of pairs that limit a step: at 0 those that touch come before those that are only too close.
bool limits_first(const Contact& x, const Contact& y) {
  if (x.toi != y.toi) return x.toi < y.toi;
  const auto touches = [](const Contact& c) { return outcome_of(c) == Outcome::initial_contact; };
  return touches(x) != touches(y) ? touches(x) : before(x, y);
}

// Lets a contact with a part that turns limit a step, if nothing else does before.
void limit_by(const Contact& contact, StepResult& r) {
  const Outcome outcome = outcome_of(contact);
  const bool touches = outcome == Outcome::initial_contact && r.outcome != outcome;
  const bool limits = contact.toi < r.step || (r.step == 0 && touches);
  if (limits) r.step = contact.toi, r.outcome = outcome, r.limiting = contact;
  if (limits || contact.toi < r.toi)
    r.toi = contact.toi, r.toi_hi = contact.toi_hi, r.certainty = contact.certainty;
  if (r.step == 0) r.shortest = 0;
  if (r.shortest > r.step) {  // a linear pair would be stored too close at any time but 0
    r.step = r.shortest = 0;
    r.outcome = Outcome::below_rounding;
  }
}

Contact to_contact(const Mesh& mesh, const FoundPair& f) {
  Contact c;
  static_cast<Pair&>(c) = to_pair(mesh, f);
  put(f.result, c);
  return c;
}

StepResult Call::step(Collect collect) {
  const Clock clock;
  const Mesh& linear = turns_ ? scene_->linear : mesh_;
  StepResult r = step_of_motion(linear, at(x0_), at(x1_), options_, collect, budget_);
  r.stats.filter_counts = mesh_.filter_counts();
  if (!turns_ || budget_.outcome() != Outcome::free || r.vertex >= 0) return r;
  if (collect == Collect::any && r.toi <= 1) return r;
  std::vector<Contact> contacts;
  for (const FoundPair& f : in_bodies(r.stats)) contacts.push_back(to_contact(mesh_, f));
  const TurningAnswer answer = turning(collect, contacts.empty() ? std::min(r.toi, 1.0) : 0);
  add(stats_of(mesh_, answer), r.stats);
  r.rounding = std::max(r.rounding, reported_rounding(answer.rounding));
  r.stats.seconds_total = clock.seconds();
  const Outcome ended = answer.outcome != Outcome::free ? answer.outcome : budget_.outcome();
  if (ended != Outcome::free) {
    r.step = r.toi = r.shortest = 0, r.toi_hi = INFINITY;
    r.limiting.reset();
    r.outcome = ended, r.vertex = answer.vertex;
    r.stats.looked_at = budget_.done();
    return r;
  }
  contacts.insert(contacts.end(), answer.contacts.begin(), answer.contacts.end());
  const auto first = std::min_element(contacts.begin(), contacts.end(), limits_first);
  if (first != contacts.end()) limit_by(*first, r);
  return r;
}

// Cuts off what the window and the memory limit exclude, and puts the rest in order.
void cut_off(const Options& options, ActiveSet& set) {
  std::vector<Contact>& contacts = set.contacts;
  if (!contacts.empty() && options.window < 1) {
    set.complete_until = std::min(set.complete_until, set.earliest()->toi + options.window);
    const auto is_later = [&](const Contact& c) { return c.toi > set.complete_until; };
    contacts.erase(std::remove_if(contacts.begin(), contacts.end(), is_later), contacts.end());
  }
  if (const std::size_t most = most_contacts(options); contacts.size() > most) {
    const auto last = contacts.begin() + std::ptrdiff_t(most);
    std::nth_element(contacts.begin(), last, contacts.end(), before_in_step);
    set.complete_until = std::min(set.complete_until, last->toi);
    if (set.outcome == Outcome::free) set.outcome = Outcome::out_of_memory;
    contacts.erase(last, contacts.end());
  }
  parallel_sort(contacts.begin(), contacts.end(),
                [](const Contact& x, const Contact& y) { return before(x, y); });
}

// Adds the contacts of pairs with a part that turns, and within rigid bodies.
void Call::add_turning(ActiveSet& set) {
  const std::vector<FoundPair> near = in_bodies(set.stats);
  if (!near.empty()) {
    ActiveSet at_rest;
    const Motion rest = make_motion(mesh_.data().num_vertices, at(x0_), at(x0_));
    fill_contacts(mesh_, rest, options_, near, budget_.interruption(), at_rest);
    for (Contact& c : at_rest.contacts) c.outcome = PairOutcome::initial_contact;
    set.contacts.insert(set.contacts.end(), at_rest.contacts.begin(), at_rest.contacts.end());
  }
  double until = 1;
  if (const Contact* first = set.earliest()) until = std::min(until, first->toi + options_.window);
  TurningAnswer answer = turning(Collect::all, until);
  add(stats_of(mesh_, answer), set.stats);
  for (Contact& c : answer.contacts)
    if (c.outcome == PairOutcome::below_rounding) c.outcome = PairOutcome::initial_contact;
  set.contacts.insert(set.contacts.end(), answer.contacts.begin(), answer.contacts.end());
  set.complete_until = answer.complete_until;
  set.outcome = answer.outcome, set.vertex = answer.vertex;
  if (set.vertex >= 0) set.contacts.clear();
}

ActiveSet Call::active_set() {
  const Clock clock;
  ActiveSet set;
  const Mesh& linear = turns_ ? scene_->linear : mesh_;
  StepSetup setup(linear, at(x0_), at(x1_), options_, StepSetup::Use::contacts, set.stats, budget_);
  set.stats.filter_counts = mesh_.filter_counts();
  set.outcome = setup.motion.status, set.vertex = setup.motion.bad_vertex;
  if (set.outcome != Outcome::free) return set;
  set.complete_until = INFINITY;
  set.planes = mesh_.data().planes;
  const TraversalResult traversal = find_contacts(linear, setup, options_, Collect::all, budget_, set.stats);
  note_worst(mesh_, traversal, set.stats);
  fill_contacts(mesh_, setup.motion, options_, traversal.found, budget_.interruption(), set);
  if (turns_ && budget_.outcome() == Outcome::free) add_turning(set);
  cut_off(options_, set);
  if (budget_.outcome() != Outcome::free) {
    set.outcome = budget_.outcome();
    set.complete_until = 0;
    set.stats.looked_at = budget_.done();
  }
  set.stats.contacts = {};
  for (const Contact& c : set.contacts) ++count_of(c.kind, set.stats.contacts);
  if (set.size() > 0 && set.outcome == Outcome::free) set.outcome = Outcome::contact;
  set.stats.seconds_total = clock.seconds();
  return set;
}

}  // namespace

StepResult compute_collision_free_stepsize(const Mesh& mesh, const Trajectory& trajectory,
                                           const Options& options) {
  check(options);
  StepResult r;
  in_arena(options.threads, [&] {
    Budget budget(options);
    r = Call(mesh, trajectory, options, budget).step(Collect::first);
  });
  return r;
}

bool is_step_collision_free(const Mesh& mesh, const Trajectory& trajectory, const Options& options) {
  check(options);
  StepResult r;
  in_arena(options.threads, [&] {
    Budget budget(options);
    r = Call(mesh, trajectory, options, budget).step(Collect::any);
  });
  return r.outcome == Outcome::free && r.toi > 1;
}

ActiveSet construct_active_set(const Mesh& mesh, const Trajectory& trajectory, const Options& options) {
  check(options);
  ActiveSet set;
  in_arena(options.threads, [&] {
    Budget budget(options);
    set = Call(mesh, trajectory, options, budget).active_set();
  });
  return set;
}

}  // namespace onset
