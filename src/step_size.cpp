#include "onset/step_size.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "base/float_environment.hpp"
#include "base/parallel.hpp"
#include "onset/candidates.hpp"
#include "scene/pair_source.hpp"
#include "scene/planes.hpp"
#include "scene/primitive_filter.hpp"
#include "src/shared/checked_options.hpp"
#include "src/shared/find_contacts.hpp"
#include "src/shared/pair_list.hpp"

namespace onset {
namespace {

StepResult step_in_arena(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1,
                         const Options& options, Collect collect) {
  Budget budget(options);
  return step_of_motion(mesh, x_t0, x_t1, options, collect, budget);
}

[[noreturn]] void reject(PairKind kind, std::size_t row, const std::string& why) {
  throw std::invalid_argument(std::string(to_string(kind)) + " row " + std::to_string(row) + ": " + why);
}

// Checks the rows up to where the budget ends, if it does.
std::vector<IdPair> checked(const MeshData& mesh, PairKind kind, const std::vector<std::array<int, 2>>& list,
                            Budget& budget) {
  if (!list.empty() && !has_kind(mesh, kind))
    reject(kind, 0, std::string("the mesh has ") + (mesh.dimension == 2 ? "two" : "three") + " dimensions");
  const bool single = kind != PairKind::edge_edge;  // a vertex on the first side
  const int firsts = int(primitive_count(mesh, first_primitive(kind)));
  const int seconds = int(primitive_count(mesh, second_primitive(kind)));
  std::vector<IdPair> pairs;
  pairs.reserve(list.size());
  each_unless(budget.stop(), 0, list.size(), [&](std::size_t i) {
    IdPair p{list[i][0], list[i][1]};
    if (p.a < 0 || p.a >= firsts || p.b < 0 || p.b >= seconds)
      reject(kind, i, "the mesh has no pair " + std::to_string(p.a) + ", " + std::to_string(p.b));
    if (!single && p.a > p.b) std::swap(p.a, p.b);
    const std::array<int, 4> v = pair_vertices(mesh, kind, p);
    for (int k = single ? 1 : 2; k < 4; ++k)
      if (v[0] == v[std::size_t(k)] || (!single && v[1] == v[std::size_t(k)]))
        reject(kind, i, "the two share vertex " + std::to_string(v[std::size_t(k)]));
    if (may_meet(mesh, kind, p.a, p.b)) pairs.push_back(p);
  });
  return pairs;
}

std::vector<IdPair> checked_planes(const MeshData& mesh, const std::vector<std::array<int, 2>>& list,
                                   Budget& budget) {
  std::vector<IdPair> pairs;
  each_unless(budget.stop(), 0, list.size(), [&](std::size_t i) {
    const IdPair p{list[i][0], list[i][1]};
    if (p.a < 0 || p.a >= mesh.num_vertices || p.b < 0 || std::size_t(p.b) >= mesh.planes.size())
      reject(PairKind::vertex_plane, i,
             "the mesh has no pair " + std::to_string(p.a) + ", " + std::to_string(p.b));
    if (may_meet_plane(mesh, p.a, p.b)) pairs.push_back(p);
  });
  return pairs;
}

}  // namespace

StepResult compute_collision_free_stepsize(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1,
                                           const Options& options) {
  check(options);
  StepResult r;
  in_arena(options.threads, [&] { r = step_in_arena(mesh, x_t0, x_t1, options, Collect::first); });
  return r;
}

bool is_step_collision_free(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1,
                            const Options& options) {
  check(options);
  StepResult r;
  in_arena(options.threads, [&] { r = step_in_arena(mesh, x_t0, x_t1, options, Collect::any); });
  return r.outcome == Outcome::free && r.toi > 1;
}

StepResult compute_collision_free_stepsize(const Mesh& mesh, const Candidates& candidates,
                                           const Positions& x_t0, const Positions& x_t1,
                                           const Options& options, double gap_share) {
  check(options);
  check_gap_share(gap_share);
  if (candidates.outcome != Outcome::free)
    throw std::invalid_argument(std::string("candidates ended with ") + to_string(candidates.outcome) +
                                ": they are not complete");
  StepResult r;
  in_arena(options.threads, [&] {
    const Clock clock;
    Budget budget(options);
    PairList pairs;
    pairs.of(PairKind::vertex_face) =
        checked(mesh.data(), PairKind::vertex_face, candidates.vertex_face, budget);
    pairs.of(PairKind::edge_edge) = checked(mesh.data(), PairKind::edge_edge, candidates.edge_edge, budget);
    pairs.of(PairKind::vertex_edge) =
        checked(mesh.data(), PairKind::vertex_edge, candidates.vertex_edge, budget);
    pairs.of(PairKind::vertex_plane) = checked_planes(mesh.data(), candidates.vertex_plane, budget);
    r = step_of_pairs(mesh, make_motion(mesh.data(), x_t0, x_t1), pairs, options, gap_share, budget);
    r.stats.seconds_total = clock.seconds();
  });
  return r;
}

void in_default_float_environment(const std::function<void()>& work) { in_float_environment(work); }

}  // namespace onset
