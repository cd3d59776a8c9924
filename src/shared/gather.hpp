// All pairs of a source looked at in parallel, and what is found among them, within a budget of time and
// memory.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <mutex>
#include <vector>

#include "base/parallel.hpp"
#include "scene/pair_sink.hpp"
#include "src/shared/budget.hpp"

namespace onset {

template <class Found>
struct Gathered {
  std::vector<Found> found;  // in no particular order
  bool too_many = false;     // more than were to be kept: `found` is empty, and not all pairs were looked at
};

// visit(kind, pairs, count, found) appends to `found`, from any thread. Keeps `most` at most; a spent budget
// ends it early, with what was found until then.
template <class Found, class Visit>
Gathered<Found> gather(const PairSource& pairs, const std::vector<PairKind>& kinds, std::size_t most,
                       Budget& budget, const Visit& visit) {
  constexpr std::size_t kBlocksATask = 4;
  struct Task {
    PairKind kind;
    const Visit& visit;
    std::size_t most;
    Budget& budget;
    std::atomic<bool>& too_many;
    std::vector<Found> found;

    static void consume(void* context, const IdPair* batch, std::size_t count) {
      auto& task = *static_cast<Task*>(context);
      if (task.too_many || task.budget.spent()) return;
      task.visit(task.kind, batch, count, task.found);
      if (task.found.size() > task.most) task.too_many = true;
    }
  };
  Gathered<Found> all;
  std::mutex mutex;
  std::atomic<bool> too_many{false};
  std::size_t blocks = 0;
  for (const PairKind kind : kinds) blocks += pairs.blocks(kind);
  budget.begin_traversal(blocks);
  for (const PairKind kind : kinds)
    parallel_ranges(pairs.blocks(kind), kBlocksATask, [&](std::size_t first, std::size_t last) {
      if (too_many || budget.spent()) return;
      Task task{kind, visit, most, budget, too_many, {}};
      pairs.traverse(kind, first, last, {&task, &Task::consume});
      budget.advance(last - first);
      const std::lock_guard<std::mutex> lock(mutex);
      all.found.insert(all.found.end(), task.found.begin(), task.found.end());
      if (all.found.size() > most) too_many = true;
    });
  all.too_many = too_many;
  if (too_many) all.found.clear();
  return all;
}

}  // namespace onset
