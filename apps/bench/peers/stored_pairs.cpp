#include "bench/peers/stored_pairs.hpp"

#include <tbb/task_arena.h>

namespace app {

struct StoredPairs::Lists {
  std::vector<std::array<int, 2>> vertex_face, edge_edge;
};

StoredPairs::StoredPairs(const onset::Mesh& mesh) : mesh_(&mesh) {}
StoredPairs::~StoredPairs() = default;

onset::PairCounts StoredPairs::find(const onset::Positions& x_t0, const onset::Positions& x_t1, int threads) {
  mesh_->release_memory();
  lists_.resize(std::size_t(threads));
  for (Lists& lists : lists_) lists.vertex_face.clear(), lists.edge_edge.clear();
  const auto store = [&](onset::PairKind kind, const std::array<int, 2>* pairs, std::size_t count) {
    Lists& mine = lists_[std::size_t(tbb::this_task_arena::current_thread_index())];
    auto& list = kind == onset::PairKind::vertex_face ? mine.vertex_face : mine.edge_edge;
    list.insert(list.end(), pairs, pairs + count);
  };
  onset::Options options;
  options.threads = threads;
  return onset::visit_candidates(*mesh_, x_t0, x_t1, store, options).counts;
}

}  // namespace app
