// Parallel visits of all pairs of a source.
#pragma once

#include <atomic>
#include <cstddef>
#include <mutex>
#include <vector>

#include "base/parallel.hpp"
#include "scene/pair_source.hpp"
#include "src/shared/budget.hpp"

namespace onset {

// Calls visit(state, pairs, count) for each batch of a task's blocks, from any thread, where `state` is the
// task's copy of `initial`, and then merge(state), for one task at a time. Once ended() is true, or the
// budget is spent, batches and tasks that have not begun are left out. The caller's progress is called
// outside of merge: it may run parallel work that is given a task of this call.
template <class State, class Visit, class Merge, class Ended>
void visit_pairs(const PairSource& source, PairKind kind, std::size_t blocks_a_task, const State& initial,
                 Budget& budget, const Visit& visit, const Merge& merge, const Ended& ended) {
  struct Task {
    State state;
    Budget& budget;
    const Visit& visit;
    const Ended& ended;
    static void consume(void* context, const IdPair* pairs, std::size_t count) {
      auto& task = *static_cast<Task*>(context);
      if (!task.ended() && !task.budget.spent()) task.visit(task.state, pairs, count);
    }
  };
  std::mutex mutex;
  parallel_ranges(source.blocks(kind), blocks_a_task, [&](std::size_t first, std::size_t last) {
    if (ended() || budget.spent()) return;
    Task task{initial, budget, visit, ended};
    source.traverse(kind, first, last, {&task, &Task::consume});
    {
      const std::lock_guard<std::mutex> lock(mutex);
      merge(task.state);
    }
    if (!budget.spent()) budget.advance(last - first);
  });
}

// What is found among the pairs of a source, in no particular order.
template <class Found>
struct Gathered {
  std::vector<Found> found;
  // Whether there is more than was to be kept. `found` is then empty, and not all pairs were looked at.
  bool too_many = false;
};

// Gathers what visit(kind, pairs, count, found), called from any thread, appends to `found`: at most `most`.
// A spent budget ends it early, with what was found until then.
template <class Found, class Visit>
Gathered<Found> gather(const PairSource& pairs, const std::vector<PairKind>& kinds, std::size_t most,
                       Budget& budget, const Visit& visit) {
  constexpr std::size_t kBlocksATask = 4;
  Gathered<Found> all;
  std::atomic<bool> too_many{false};
  std::size_t blocks = 0;
  for (const PairKind kind : kinds) blocks += pairs.blocks(kind);
  budget.begin_traversal(blocks);
  for (const PairKind kind : kinds)
    visit_pairs(
        pairs, kind, kBlocksATask, std::vector<Found>(), budget,
        [&](std::vector<Found>& found, const IdPair* batch, std::size_t count) {
          visit(kind, batch, count, found);
          if (found.size() > most) too_many = true;
        },
        [&](const std::vector<Found>& found) {
          all.found.insert(all.found.end(), found.begin(), found.end());
          if (all.found.size() > most) too_many = true;
        },
        [&] { return too_many.load(); });
  all.too_many = too_many;
  if (too_many) all.found.clear();
  return all;
}

}  // namespace onset
