#include "src/shared/pair_list.hpp"

#include <algorithm>
#include <atomic>
#include <mutex>

#include "base/parallel.hpp"

namespace onset {
namespace {

struct Task {
  PairKind kind;
  const std::vector<CulledList>& lists;
  std::atomic<std::int64_t>& room;
  Budget& budget;
  NarrowPhaseScratch scratch;
  std::vector<std::vector<IdPair>> kept;

  static void consume(void* context, const IdPair* pairs, std::size_t count) {
    auto& task = *static_cast<Task*>(context);
    if (task.room < 0 || task.budget.spent()) return;
    for (std::size_t i = 0; i < task.lists.size(); ++i) {
      const std::size_t before = task.kept[i].size();
      task.lists[i].narrow.cull(task.kind, pairs, count, task.scratch, task.kept[i]);
      task.room -= std::int64_t(task.kept[i].size() - before);
    }
  }
};

}  // namespace

std::size_t PairList::blocks(PairKind kind) const { return (of(kind).size() + kBatchSize - 1) / kBatchSize; }

void PairList::traverse(PairKind kind, std::size_t first, std::size_t last, const PairSink& sink) const {
  for (std::size_t block = first; block < last; ++block) {
    const std::size_t begin = block * kBatchSize, end = std::min(begin + kBatchSize, of(kind).size());
    sink(of(kind).data() + begin, end - begin);
  }
}

bool cull_into(const PairSource& broad, const std::vector<CulledList>& lists, std::int64_t most, Budget& budget) {
  std::atomic<std::int64_t> room{most};
  for (const PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
    std::mutex mutex;
    parallel_ranges(broad.blocks(kind), 16, [&](std::size_t first, std::size_t last) {
      Task task{kind, lists, room, budget, {}, std::vector<std::vector<IdPair>>(lists.size())};
      if (room < 0 || budget.spent()) return;
      broad.traverse(kind, first, last, {&task, &Task::consume});
      const std::lock_guard<std::mutex> lock(mutex);
      if (room < 0) return;
      for (std::size_t i = 0; i < lists.size(); ++i) {
        std::vector<IdPair>& all = lists[i].list.of(kind);
        all.insert(all.end(), task.kept[i].begin(), task.kept[i].end());
      }
    });
    if (room < 0) break;
    for (const CulledList& culled : lists) {
      std::vector<IdPair>& all = culled.list.of(kind);
      parallel_sort(all.begin(), all.end(),
                    [](const IdPair& p, const IdPair& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; });
      all.shrink_to_fit();
    }
  }
  if (room < 0)
    for (const CulledList& culled : lists) culled.list = PairList();
  return room >= 0;
}

}  // namespace onset
