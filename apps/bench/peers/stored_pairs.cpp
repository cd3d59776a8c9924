#include "bench/peers/stored_pairs.hpp"

#include <mutex>

namespace app {

struct StoredPairs::Lists {
  std::vector<std::array<int, 2>> vertex_face, edge_edge;
};

StoredPairs::StoredPairs(const onset::Mesh& mesh, onset::BroadPhaseMethod method)
    : mesh_(&mesh), method_(method) {}
StoredPairs::~StoredPairs() = default;

onset::PairCounts StoredPairs::find(const onset::Positions& x_t0, const onset::Positions& x_t1, int threads) {
  mesh_->release_memory();
  lists_.resize(std::size_t(threads));
  std::mutex mutex;
  std::vector<Lists*> idle;
  for (Lists& lists : lists_) {
    lists.vertex_face.clear(), lists.edge_edge.clear();
    idle.push_back(&lists);
  }
  const auto store = [&](onset::PairKind kind, const std::array<int, 2>* pairs, std::size_t count) {
    std::unique_lock<std::mutex> lock(mutex);
    Lists* const mine = idle.back();
    idle.pop_back();
    lock.unlock();
    auto& list = kind == onset::PairKind::vertex_face ? mine->vertex_face : mine->edge_edge;
    list.insert(list.end(), pairs, pairs + count);
    lock.lock();
    idle.push_back(mine);
  };
  onset::Options options;
  options.threads = threads, options.broad_phase = method_;
  return onset::visit_candidates(*mesh_, x_t0, x_t1, store, options).counts;
}

}  // namespace app
