#include "bench/peers/stored_pairs.hpp"

#include <tbb/task_arena.h>

// The only look inside the library under apps/.
#include "base/parallel.hpp"
#include "broadphase/broad_phase.hpp"

namespace app {
namespace {

constexpr std::size_t kBlocksATask = 64;

void store(void* list, const onset::IdPair* pairs, std::size_t count) {
  auto& to = *static_cast<std::vector<onset::IdPair>*>(list);
  to.insert(to.end(), pairs, pairs + count);
}

}  // namespace

struct StoredPairs::Lists {
  std::vector<onset::IdPair> vertex_face, edge_edge;
};

StoredPairs::StoredPairs(const onset::Mesh& mesh) : mesh_(&mesh) {}
StoredPairs::~StoredPairs() = default;

onset::PairCounts StoredPairs::find(const onset::Positions& x_t0, const onset::Positions& x_t1, int threads) {
  lists_.resize(std::size_t(threads));
  for (Lists& lists : lists_) lists.vertex_face.clear(), lists.edge_edge.clear();
  const auto find_all = [&](const onset::BroadPhase& broad, onset::PairKind kind,
                            std::vector<onset::IdPair> Lists::*list) {
    onset::parallel_ranges(broad.blocks(kind), kBlocksATask, [&](std::size_t first, std::size_t last) {
      Lists& mine = lists_[std::size_t(tbb::this_task_arena::current_thread_index())];
      broad.traverse(kind, first, last, {&(mine.*list), store});
    });
  };
  onset::in_arena(threads, [&] {
    const onset::Motion motion = onset::make_motion(mesh_->data().num_vertices, x_t0, x_t1);
    const auto broad = onset::make_broad_phase(
        onset::BroadPhaseMethod::automatic,
        {mesh_->data(), motion, 0, 1, onset::BoxTest::swept, onset::InstructionSet::automatic});
    find_all(*broad, onset::PairKind::vertex_face, &Lists::vertex_face);
    find_all(*broad, onset::PairKind::edge_edge, &Lists::edge_edge);
  });
  onset::PairCounts counts;
  for (const Lists& lists : lists_) {
    counts.vertex_face += std::int64_t(lists.vertex_face.size());
    counts.edge_edge += std::int64_t(lists.edge_edge.size());
  }
  return counts;
}

}  // namespace app
