#include "onset/intersections.hpp"

#include <algorithm>
#include <limits>

#include "base/clock.hpp"
#include "base/instruction_set.hpp"
#include "narrowphase/at_rest/edge_face.hpp"
#include "narrowphase/at_rest/edges_in_plane.hpp"
#include "src/shared/checked_options.hpp"
#include "src/start/plane_starts.hpp"
#include "src/start/rest_pairs.hpp"

namespace onset {
namespace {

IntersectionKind kind_of(EdgeFace found) {
  switch (found) {
    case EdgeFace::crossing:
      return IntersectionKind::crossing;
    case EdgeFace::overlapping:
      return IntersectionKind::overlapping;
    default:
      return IntersectionKind::touching;
  }
}

void add_if_common(const MeshData& mesh, const Motion& motion, IdPair ids, std::vector<Intersection>& found) {
  const auto& e = mesh.edges[std::size_t(ids.a)];
  const auto& f = mesh.faces[std::size_t(ids.b)];
  const double* const x[5] = {motion.t0(e[0]), motion.t0(e[1]), motion.t0(f[0]), motion.t0(f[1]),
                              motion.t0(f[2])};
  const EdgeFace answer = edge_face({{x[0], x[1]}, {x[2], x[3], x[4]}});
  if (answer == EdgeFace::apart) return;
  if (mesh.weld && any_across(2, 5, [&](int i, int j) { return at_one_place(x[i], x[j]); })) return;
  found.push_back({ids.a, ids.b, kind_of(answer), {e[0], e[1], f[0], f[1], f[2]}});
}

void add_if_common_in_plane(const MeshData& mesh, const Motion& motion, IdPair ids,
                            std::vector<Intersection>& found) {
  const auto &e = mesh.edges[std::size_t(ids.a)], &f = mesh.edges[std::size_t(ids.b)];
  const double* const x[4] = {motion.t0(e[0]), motion.t0(e[1]), motion.t0(f[0]), motion.t0(f[1])};
  const EdgeFace answer = edges_in_plane({x[0], x[1]}, {x[2], x[3]});
  if (answer == EdgeFace::apart) return;
  if (mesh.weld && any_across(2, 4, [&](int i, int j) { return at_one_place(x[i], x[j]); })) return;
  found.push_back({ids.a, ids.b, kind_of(answer), {e[0], e[1], f[0], f[1], f[1]}});
}

// With both 0 it only says whether there is any.
Intersections find(const Mesh& mesh, const Positions& x, const Options& options, std::size_t most,
                   std::size_t most_planes) {
  check(options);
  resolve_instruction_set(options.instruction_set);
  Intersections r;
  in_arena(options.threads, [&] {
    const Clock clock;
    Budget budget(options);
    Rest rest(mesh, x);
    rest.find(mesh, Rest::Pairs::edge_face, options, budget);
    Gathered<Intersection> gathered;
    if (rest.broad) gathered = find_intersections(mesh, rest, most, budget);
    Gathered<std::array<int, 2>> behind;
    if (rest.broad && !gathered.too_many)
      behind = find_behind_planes(mesh, rest.motion, options, most_planes, budget);
    if (behind.too_many) gathered = {{}, true};
    r.outcome = gathered.too_many ? Outcome::out_of_memory : rest.outcome(budget);
    r.vertex = rest.motion.bad_vertex;
    r.pairs = std::move(gathered.found), r.behind_planes = std::move(behind.found);
    r.seconds = clock.seconds();
  });
  return r;
}

}  // namespace

Gathered<Intersection> find_intersections(const Mesh& mesh, const Rest& rest, std::size_t most,
                                          Budget& budget) {
  const MeshData& data = mesh.data();
  return gather<Intersection>(
      *rest.broad, {intersection_kind(data)}, most, budget,
      [&](PairKind kind, const IdPair* pairs, std::size_t count, std::vector<Intersection>& found) {
        for (std::size_t i = 0; i < count; ++i)
          if (kind == kEdgeFace)
            add_if_common(data, rest.motion, pairs[i], found);
          else
            add_if_common_in_plane(data, rest.motion, pairs[i], found);
      },
      [](const Intersection& p) {
        return IdPair{p.edge, p.face};
      });
}

const char* to_string(IntersectionKind kind) noexcept {
  switch (kind) {
    case IntersectionKind::crossing:
      return "crossing";
    case IntersectionKind::touching:
      return "touching";
    case IntersectionKind::overlapping:
      return "overlapping";
  }
  return "unknown";
}

std::size_t Intersections::count(IntersectionKind kind) const noexcept {
  return std::size_t(
      std::count_if(pairs.begin(), pairs.end(), [&](const Intersection& p) { return p.kind == kind; }));
}

Intersections intersections(const Mesh& mesh, const Positions& x, const Options& options) {
  static_assert(sizeof(Intersection) == 32, "as documented");
  return find(mesh, x, options, std::size_t(options.memory_limit) / sizeof(Intersection),
              std::size_t(options.memory_limit) / sizeof(std::array<int, 2>));
}

// The first one that is found is more than `most`, which ends the search.
bool has_intersections(const Mesh& mesh, const Positions& x, const Options& options) {
  return find(mesh, x, options, 0, 0).outcome != Outcome::free;
}

}  // namespace onset
