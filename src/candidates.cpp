#include <algorithm>
#include <atomic>
#include <mutex>

#include "base/parallel.hpp"
#include "narrowphase/narrow_phase.hpp"
#include "onset/pipeline.hpp"
#include "src/shared/checked_options.hpp"
#include "src/shared/step_setup.hpp"

namespace onset {
namespace {

// Nothing is listed any more once `room` (pairs) is used up. `welds`: where it is not null, seams of it are left out.
void list_candidates(const Mesh& mesh, const BroadPhase& broad, PairKind kind, bool list, const Motion* welds,
                     std::atomic<std::int64_t>& room, Budget& budget, std::vector<std::array<int, 2>>& pairs,
                     std::int64_t& count) {
  std::mutex mutex;
  struct Task {
    const MeshData& mesh;
    PairKind kind;
    bool list;
    const Motion* welds;
    std::atomic<std::int64_t>& room;
    Budget& budget;
    std::int64_t count;
    std::vector<std::array<int, 2>> pairs;
    static void consume(void* context, const IdPair* p, std::size_t n) {
      auto& task = *static_cast<Task*>(context);
      if (task.budget.spent()) return;
      if (task.welds != nullptr) return task.consume_unwelded(p, n);
      task.count += std::int64_t(n);
      if (task.list && (task.room -= std::int64_t(n)) >= 0)
        for (std::size_t i = 0; i < n; ++i) task.pairs.push_back({p[i].a, p[i].b});
    }
    void consume_unwelded(const IdPair* p, std::size_t n) {
      for (std::size_t i = 0; i < n; ++i) {
        if (is_seam(*welds, kind, pair_vertices(mesh, kind, p[i]))) continue;
        ++count;
        if (list && --room >= 0) pairs.push_back({p[i].a, p[i].b});
      }
    }
  };
  parallel_ranges(broad.blocks(kind), 64, [&](std::size_t first, std::size_t last) {
    Task task{mesh.data(), kind, list, welds, room, budget, 0, {}};
    if (!budget.spent()) broad.traverse(kind, first, last, {&task, &Task::consume});
    if (!budget.spent()) budget.advance(last - first);
    const std::lock_guard<std::mutex> lock(mutex);
    count += task.count;
    pairs.insert(pairs.end(), task.pairs.begin(), task.pairs.end());
  });
  parallel_sort(pairs.begin(), pairs.end(), [](const auto& p, const auto& q) { return p < q; });
}

}  // namespace

Candidates compute_candidates(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1,
                              const Options& options, bool list) {
  check(options);
  Candidates c;
  in_arena(options.threads, [&] {
    Budget budget(options);
    Scene scene(mesh, x_t0, x_t1, options, Scene::Use::candidates, c.stats, budget);
    c.outcome = scene.motion.status;
    c.vertex = scene.motion.bad_vertex;
    if (c.outcome != Outcome::free) return;
    std::atomic<std::int64_t> room{options.memory_limit / std::int64_t(sizeof(IdPair))};
    if (scene.broad) {
      budget.begin_traversal(scene.broad->blocks(PairKind::vertex_face) +
                        scene.broad->blocks(PairKind::edge_edge));
      const Motion* welds = mesh.data().weld ? &scene.motion : nullptr;
      list_candidates(mesh, *scene.broad, PairKind::vertex_face, list, welds, room, budget, c.vertex_face,
                      c.counts.vertex_face);
      list_candidates(mesh, *scene.broad, PairKind::edge_edge, list, welds, room, budget, c.edge_edge,
                      c.counts.edge_edge);
    }
    c.outcome = room < 0 ? Outcome::out_of_memory : budget.outcome();
    if (c.outcome != Outcome::free) c.vertex_face = c.edge_edge = {};
    if (budget.outcome() != Outcome::free) c.stats.looked_at = budget.done();
    c.stats.swept = c.counts;
    c.stats.seconds_total = scene.clock.seconds();
    c.stats.seconds_broad = c.stats.seconds_total;
  });
  return c;
}

}  // namespace onset
