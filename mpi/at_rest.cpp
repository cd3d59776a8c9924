#include <utility>

#include "base/float_environment.hpp"
#include "mpi/results.hpp"
#include "onset/mpi/calls.hpp"
#include "src/part/part_of_step.hpp"
#include "src/shared/close_set.hpp"

namespace onset::mpi {
namespace {

// (c) Makes the part for a call on one set of positions; `status` says where it cannot.
Part part_at(const Mesh::Impl& m, const Positions& x, const Options& options, bool close, double d_hat,
             std::pair<Outcome, int>& status) {
  OwnMotion own = take_motion(m, x, x);
  status = {own.motion.status, own.motion.bad_vertex};
  if (status.first != Outcome::free) return {};
  double inflation = 0;
  m.comm.agreed([&] {
    if (close) inflation = largest_inflation(reach_data(m, own.whole), options, StepSetup::Use::close, d_hat);
  });
  return make_part(m, std::move(own), inflation, close ? Meetings::contacts : Meetings::intersections);
}

// (c) Ends a call on pairs at rest: all ranks have one outcome, and no pairs where one has none.
template <class Result>
void agree(const Communicator& comm, Result& r) {
  r.outcome = agreed_outcome(comm, r.outcome);
  comm.maximum(&r.seconds, 1);
}

Intersections find(const Mesh::Impl& m, const Positions& x, const Options& options, bool any) {
  const FloatEnvironment environment;
  Intersections r;
  begin_call(m, any ? "has intersections" : "intersections", options);
  std::pair<Outcome, int> status;
  const Part part = part_at(m, x, options, false, 0, status);
  r.outcome = status.first, r.vertex = status.second;
  end_call(m, 0);
  if (r.outcome != Outcome::free) return r;
  m.comm.agreed([&] {
    if (any) {
      if (onset::has_intersections(part.mesh, part.start(), options)) r.outcome = Outcome::contact;
      return;
    }
    r = onset::intersections(part.mesh, part.start(), options);
    const Primitive second = m.dimension == 2 ? Primitive::edge : Primitive::face;
    for (Intersection& p : r.pairs) {
      p.edge = part.id_of(Primitive::edge, p.edge), p.face = part.id_of(second, p.face);
      part.rename_vertices(p.vertices);
    }
    for (std::array<int, 2>& p : r.behind_planes) p[0] = part.id_of(Primitive::vertex, p[0]);
  });
  agree(m.comm, r);
  return r;
}

}  // namespace

ClosePairs close_pairs(const Mesh& mesh, const Positions& x, double d_hat, const Options& options) {
  const FloatEnvironment environment;
  const Mesh::Impl& m = mesh.impl();
  ClosePairs r;
  const auto check = [&] { check_d_hat(d_hat, false); };
  begin_call(m, "close pairs", options, {d_hat}, FunctionRef<>(check));
  std::pair<Outcome, int> status;
  const Part part = part_at(m, x, options, true, d_hat, status);
  r.d_hat = d_hat, r.outcome = status.first, r.vertex = status.second;
  end_call(m, 0);
  if (r.outcome != Outcome::free) return r;
  m.comm.agreed([&] {
    static_cast<onset::ClosePairs&>(r) = onset::close_pairs(part.mesh, part.start(), d_hat, options);
    r.owners = rename_all(part, r.pairs);
  });
  agree(m.comm, r);
  if (r.outcome != Outcome::free) r.pairs.clear(), r.owners.clear();
  return r;
}

Intersections intersections(const Mesh& mesh, const Positions& x, const Options& options) {
  Intersections r = find(mesh.impl(), x, options, false);
  if (r.outcome == Outcome::out_of_memory) r.pairs.clear(), r.behind_planes.clear();
  return r;
}

bool has_intersections(const Mesh& mesh, const Positions& x, const Options& options) {
  return find(mesh.impl(), x, options, true).outcome != Outcome::free;
}

}  // namespace onset::mpi
