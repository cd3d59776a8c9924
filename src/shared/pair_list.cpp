#include "scene/pair_source.hpp"
#include "src/shared/pair_list.hpp"

#include <algorithm>
#include <atomic>

#include "src/shared/visit_pairs.hpp"

namespace onset {

constexpr std::size_t kBlocksATask = 16;
std::size_t PairList::blocks(PairKind kind) const { return (of(kind).size() + kBatchSize - 1) / kBatchSize; }

void PairList::traverse(PairKind kind, std::size_t first, std::size_t last, const PairSink& sink) const {
  for (std::size_t block = first; block < last; ++block) {
    const std::size_t begin = block * kBatchSize, end = std::min(begin + kBatchSize, of(kind).size());
    sink(of(kind).data() + begin, end - begin);
  }
}

bool cull_into(const PairSource& broad, const std::vector<CulledList>& lists, std::int64_t most, Budget& budget) {
  struct Task {
    NarrowPhaseScratch scratch;
    std::vector<std::vector<IdPair>> kept;
  };
  const Task initial{{}, std::vector<std::vector<IdPair>>(lists.size())};
  std::atomic<std::int64_t> room{most};
  const auto ended = [&] { return room < 0 || budget.spent(); };
  for (const PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
    const auto cull = [&](Task& task, const IdPair* pairs, std::size_t count) {
      for (std::size_t i = 0; i < lists.size(); ++i) {
        const std::size_t before = task.kept[i].size();
        lists[i].narrow.cull(kind, pairs, count, task.scratch, task.kept[i]);
        room -= std::int64_t(task.kept[i].size() - before);
      }
    };
    const auto merge = [&](const Task& task, std::size_t) {
      for (std::size_t i = 0; i < lists.size() && room >= 0; ++i) {
        std::vector<IdPair>& all = lists[i].list.of(kind);
        all.insert(all.end(), task.kept[i].begin(), task.kept[i].end());
      }
    };
    visit_pairs(broad, kind, kBlocksATask, initial, cull, merge, ended);
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
