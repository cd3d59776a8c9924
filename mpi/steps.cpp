#include <cmath>
#include <limits>

#include "base/float_environment.hpp"
#include "mpi/results.hpp"
#include "onset/mpi/calls.hpp"
#include "scene/motion/storing.hpp"
#include "src/part/part_of_step.hpp"

namespace onset::mpi {
namespace {

// A step or an active set: what all of them begin with.
struct StepCall {
  OwnMotion own;
  Part part;
  std::unique_ptr<PartOfStep> found;
};

// (c) Nothing is found where the motion is not usable: own.motion.status.
StepCall find(const Mesh::Impl& m, const Positions& x_t0, const Positions& x_t1, const Options& options,
              Collect collect) {
  StepCall call;
  call.own = take_motion(m, x_t0, x_t1);
  if (call.own.motion.status != Outcome::free) return call;
  double inflation = 0;
  m.comm.agreed([&] {
    inflation = largest_inflation(
        reach_data(m, call.own.whole), options,
        collect == Collect::first ? StepSetup::Use::stored_step : StepSetup::Use::contacts, 0);
  });
  call.part = make_part(m, std::move(call.own), inflation);
  m.comm.agreed([&] {
    Part& part = call.part;
    call.found = std::make_unique<PartOfStep>(part.mesh, part.start(), part.end(), options, collect);
    part.x_t0 = {}, part.x_t1 = {};
    call.found->find();
  });
  return call;
}

StepResult step(const Mesh::Impl& m, const Positions& x_t0, const Positions& x_t1, const Options& options,
                Collect collect) {
  const FloatEnvironment environment;
  StepResult r;
  begin_call(m, collect == Collect::first ? "step" : "free", options);
  const StepCall call = find(m, x_t0, x_t1, options, collect);
  if (!call.found) {
    r.outcome = call.own.motion.status, r.vertex = call.own.motion.bad_vertex;
    end_call(m, 0);
    return r;
  }
  r.stats = call.found->stats();
  end_call(m, r.stats.candidates.total());
  r.outcome = agreed_outcome(m.comm, call.found->outcome());
  reduce(m.comm, r.stats);
  const SceneLimits limits = reduce(m.comm, call.part, call.found->limits());
  if (r.outcome == Outcome::free) limit_step(limits, 1, r);
  r.rounding = reported_rounding(call.found->rounding());
  return r;
}

// (c) Returns the least of all ranks' values.
double least(const Communicator& comm, double value) {
  comm.minimum(&value, 1);
  return value;
}

// (c) Makes outcome and complete_until of a part those of the scene.
void agree(const Communicator& comm, ActiveSet& set) {
  std::int64_t any = set.size() > 0;
  comm.maximum(&any, 1);
  set.complete_until = least(comm, set.complete_until);
  const bool found = set.outcome == Outcome::contact;
  set.outcome = agreed_outcome(comm, found ? Outcome::free : set.outcome);
  if (set.outcome == Outcome::free && any != 0) set.outcome = Outcome::contact;
}

}  // namespace

StepResult compute_collision_free_stepsize(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1,
                                           const Options& options) {
  return step(mesh.impl(), x_t0, x_t1, options, Collect::first);
}

bool is_step_collision_free(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1,
                            const Options& options) {
  const StepResult r = step(mesh.impl(), x_t0, x_t1, options, Collect::any);
  return r.outcome == Outcome::free && r.toi > 1;
}

ActiveSet construct_active_set(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1,
                               const Options& options) {
  const FloatEnvironment environment;
  const Mesh::Impl& m = mesh.impl();
  ActiveSet set;
  set.dimension = m.dimension;
  begin_call(m, "active set", options);
  const StepCall call = find(m, x_t0, x_t1, options, Collect::all);
  if (!call.found) {
    set.outcome = call.own.motion.status, set.vertex = call.own.motion.bad_vertex;
    end_call(m, 0);
    return set;
  }
  const double latest = least(m.comm, call.found->least_toi_hi());
  m.comm.agreed([&] { call.found->sharpen(latest); });
  const double earliest = least(m.comm, call.found->earliest());
  m.comm.agreed([&] {
    static_cast<onset::ActiveSet&>(set) = call.found->contacts(earliest);
    set.owners = rename_all(call.part, set.contacts);
  });
  end_call(m, set.stats.candidates.total());
  agree(m.comm, set);
  reduce(m.comm, set.stats);
  return set;
}

}  // namespace onset::mpi
