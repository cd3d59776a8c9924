// All pairs of a source visited in parallel, with a state for each task and one merge of it.
#pragma once

#include <cstddef>
#include <mutex>
#include <type_traits>

#include "base/parallel.hpp"
#include "scene/pair_sink.hpp"

namespace onset {

// visit(state, pairs, count) for each batch of a task's blocks, from any thread, `state` being the task's copy of `initial`;
// then merge(state, blocks), for one task at a time. Once ended() says so, batches and tasks that have not begun are left out.
template <class State, class Visit, class Merge, class Ended>
void visit_pairs(const PairSource& source, PairKind kind, std::size_t blocks_a_task, const State& initial,
                 const Visit& visit, const Merge& merge, const Ended& ended) {
  struct Task {
    State state;
    const Visit& visit;
    const Ended& ended;
    static void consume(void* context, const IdPair* pairs, std::size_t count) {
      auto& task = *static_cast<Task*>(context);
      if (!task.ended()) task.visit(task.state, pairs, count);
    }
  };
  std::mutex mutex;
  parallel_ranges(source.blocks(kind), blocks_a_task, [&](std::size_t first, std::size_t last) {
    if (ended()) return;
    Task task{initial, visit, ended};
    source.traverse(kind, first, last, {&task, &Task::consume});
    const std::lock_guard<std::mutex> lock(mutex);
    merge(task.state, last - first);
  });
}

}  // namespace onset
