#include "onset/check.hpp"

#include <algorithm>

#include "base/clock.hpp"
#include "base/instruction_set.hpp"
#include "base/radix_sort.hpp"
#include "narrowphase/at_rest/edge_face.hpp"
#include "scene/pairs/vertex_rings.hpp"
#include "src/shared/checked_options.hpp"
#include "src/shared/rest/rest_limits.hpp"
#include "src/start/places.hpp"
#include "src/start/plane_starts.hpp"
#include "src/start/rest_pairs.hpp"
#include "src/start/start_findings.hpp"

namespace onset {
namespace {

// Marks for each vertex whether an edge, a face or a point uses it, and whether one of these is not static as
// a whole.
struct Use {
  std::vector<bool> used, meets;

  // Not all are marked where it is stopped.
  Use(const MeshData& mesh, const Stop& stop) : used(std::size_t(mesh.num_vertices)), meets(used) {
    for (const Primitive kind : {Primitive::edge, Primitive::face})
      each_unless(stop, 0, primitive_count(mesh, kind), [&](std::size_t id) {
        const bool still = is_static(mesh, kind, int(id));
        for (const int v : primitive_vertices(mesh, kind, int(id))) {
          used[std::size_t(v)] = true;
          if (!still) meets[std::size_t(v)] = true;
        }
      });
  }
};

bool joined(const MeshData& mesh, int v, int w) {
  if (mesh.rings && mesh.rings->near(v, w)) return true;
  return std::binary_search(mesh.excluded_vertices.begin(), mesh.excluded_vertices.end(),
                            std::array<int, 2>{v, w});
}

// Says whether what is at v never meets what is at w: all is static, or in one body that does not meet
// itself, or in two bodies that are excluded.
bool never_meet(const MeshData& mesh, const Use& use, int v, int w) {
  if (!use.meets[std::size_t(v)] && !use.meets[std::size_t(w)]) return true;
  const PrimitiveFilter& filter = *mesh.filter;
  if (!filter.keeps_apart()) return false;
  const auto& keys = filter.keys[std::size_t(Primitive::vertex)];
  const int body = keys[std::size_t(v)].body;
  if (body != 0 && body == keys[std::size_t(w)].body) return true;
  if (mesh.excluded_bodies.empty()) return false;
  const int b = mesh.body[std::size_t(v)], c = mesh.body[std::size_t(w)];
  return std::binary_search(mesh.excluded_bodies.begin(), mesh.excluded_bodies.end(),
                            std::array<int, 2>{std::min(b, c), std::max(b, c)});
}

void list_copies(const MeshData& mesh, const Use& use, const Positions& x, Budget& budget,
                 StartReport& report) {
  if (mesh.weld) return;
  const Stop stop = budget.stop();
  for (std::vector<int> here : shared_places(x, stop)) {
    here.erase(std::remove_if(here.begin(), here.end(), [&](int v) { return !use.used[std::size_t(v)]; }),
               here.end());
    for (std::size_t j = 1; j < here.size(); ++j) {
      const auto meets = [&](int v) {
        return !joined(mesh, v, here[j]) && !never_meet(mesh, use, v, here[j]);
      };
      if (stop.requested()) break;
      const auto end = here.begin() + std::ptrdiff_t(j), first = std::find_if(here.begin(), end, meets);
      if (first != end) report.copied_vertices.push_back({*first, here[j]});
    }
  }
  radix_sort(report.copied_vertices, [](const std::array<int, 2>& pair) {
    return std::uint64_t(pair[0]) << 32 | std::uint64_t(pair[1]);
  });
}

void list_faces(const MeshData& mesh, const Motion& motion, Budget& budget, StartReport& report) {
  each_unless(budget.stop(), 0, mesh.faces.size(), [&](std::size_t f) {
    const auto& [a, b, c] = mesh.faces[f];
    if (exactly_collinear(motion.t0(a), motion.t0(b), motion.t0(c)))
      report.faces_without_area.push_back(int(f));
  });
}

std::size_t most(const Options& options, std::size_t bytes) {
  return std::size_t(options.memory_limit) / bytes;
}

// Fills the lists of pairs, one after the other: none of them where one is more than memory_limit allows.
void list_pairs(const Mesh& mesh, const Options& options, Budget& budget, Rest& rest, StartReport& report) {
  rest.find(mesh, Rest::Pairs::edge_face, options, budget);
  bool too_many = false;
  if (rest.broad) {
    auto all = find_intersections(mesh, rest, most(options, sizeof(Intersection)), budget);
    report.intersections = std::move(all.found), too_many = all.too_many;
  }
  rest.broad.reset();
  const std::shared_ptr<const RestLimits> limits = rest_limits(mesh.data(), options, budget);
  too_many = too_many || budget.outcome() == Outcome::out_of_memory;
  rest.find(mesh, Rest::Pairs::within_separation, options, budget);
  if (rest.broad) {
    auto all = find_near(mesh, rest, options, limits.get(), most(options, sizeof(NearPair)), budget);
    add_near_planes(mesh, rest.motion, options, most(options, sizeof(NearPair)), budget, all);
    too_many = too_many || all.too_many;
    std::size_t touching = 0;
    for (const NearPair& p : all.found) touching += p.touches;
    report.touching.reserve(touching), report.within_separation.reserve(all.found.size() - touching);
    each_unless(budget.interruption(), 0, all.found.size(), [&](std::size_t i) {
      if (const NearPair& p = all.found[i]; p.touches)
        report.touching.push_back(p.pair);
      else
        report.within_separation.push_back(p.pair);
    });
  }
  report.outcome = rest.outcome(budget);
  if (too_many) {
    report.intersections = {}, report.touching = {}, report.within_separation = {};
    report.outcome = Outcome::out_of_memory;
  }
}

}  // namespace

StartReport check(const Mesh& mesh, const Positions& x, const Options& options) {
  check(options);
  resolve_instruction_set(options.instruction_set);
  StartReport report;
  in_arena(options.threads, [&] {
    const Clock clock;
    Budget budget(options);
    Rest rest(mesh, x);
    report.vertex = rest.motion.bad_vertex;
    const Use use(mesh.data(), budget.stop());
    report.outcome = rest.outcome(budget);
    for (std::size_t v = 0; v < use.used.size() && budget.outcome() == Outcome::free; ++v)
      if (!use.used[v]) report.unused_vertices.push_back(int(v));
    if (report.outcome == Outcome::free) {
      list_copies(mesh.data(), use, in_space(mesh.data(), "x", x), budget, report);
      list_faces(mesh.data(), rest.motion, budget, report);
      list_pairs(mesh, options, budget, rest, report);
    }
    report.findings = start_findings(mesh, report);
    report.seconds = clock.seconds();
  });
  return report;
}

}  // namespace onset
