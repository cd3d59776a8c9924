// Parallel visits of all pairs of a source.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <mutex>
#include <vector>

#include "base/parallel.hpp"
#include "base/parts.hpp"
#include "scene/pair_source.hpp"
#include "src/shared/budget.hpp"

namespace onset {

// Calls visit(state, pairs, count) for each batch of a task's blocks, from any thread, where `state` is the
// task's copy of `initial`, and then merge(state), for one task at a time. Once ended() is true, or the
// budget is spent, batches and tasks that have not begun are left out, and so is the rest of a block. The
// caller's progress is called outside of merge.
template <class State, class Visit, class Merge, class Ended>
void visit_pairs(const PairSource& source, PairKind kind, std::size_t blocks_a_task, const State& initial,
                 Budget& budget, const Visit& visit, const Merge& merge, const Ended& ended) {
  struct Task {
    State state;
    Budget& budget;
    const Visit& visit;
    const Ended& ended_early;
    bool ended() const { return ended_early() || budget.spent(); }
    static bool asked(void* context) { return static_cast<const Task*>(context)->ended(); }
    static void consume(void* context, const IdPair* pairs, std::size_t count) {
      auto& task = *static_cast<Task*>(context);
      const std::size_t most = task.budget.is_watched() ? kWatchedPairs : count;
      for (std::size_t n; count > 0 && !task.ended(); pairs += n, count -= n)
        task.visit(task.state, pairs, n = std::min(most, count));
    }
  };
  std::mutex mutex;
  parallel_ranges(source.blocks(kind), blocks_a_task, [&](std::size_t first, std::size_t last) {
    Task task{initial, budget, visit, ended};
    if (task.ended()) return;
    source.traverse(kind, first, last, {&task, &Task::consume, {&task, &Task::asked}});
    {
      const std::lock_guard<std::mutex> lock(mutex);
      merge(task.state);
    }
    if (!budget.spent()) budget.advance(last - first);
  });
}

// So many rows of a list that time or the caller cut off are still put in order, a matter of milliseconds.
inline constexpr std::size_t kRowsCutOff = 1 << 16;

// Appends all items to `found` in the order of their keys, or some of them where time or the caller ends it.
template <class Found, class Key>
void sort_within(Budget& budget, Parts<Found>& parts, const Key& key, std::vector<Found>& found) {
  const Stop stop = budget.interruption();
  Parts<Found> some;
  if (stop.asked != nullptr) parts.copy_some(some, kRowsCutOff);
  if (stop.requested() || !parts.sort_into(found, key, stop)) {
    parts.clear();
    some.sort_into(found, key, {});
  }
}

// What is found among the pairs of a source, in order.
template <class Found>
struct Gathered {
  std::vector<Found> found;
  // Whether there is more than was to be kept. `found` is then empty, and not all pairs were looked at.
  bool too_many = false;
};

// Gathers what visit(kind, pairs, count, found), called from any thread, appends to `found`: at most `most`,
// ordered by kind, and within a kind by the ids (a, b) = ids_of(found). A spent budget ends it early, with
// some of what was found until then: kRowsCutOff of a kind at most.
template <class Found, class Visit, class IdsOf>
Gathered<Found> gather(const PairSource& pairs, const std::vector<PairKind>& kinds, std::size_t most,
                       Budget& budget, const Visit& visit, const IdsOf& ids_of) {
  constexpr std::size_t kBlocksATask = 4;
  Gathered<Found> all;
  std::array<Parts<Found>, kPairKinds> parts;
  std::atomic<std::size_t> count{0};
  std::size_t blocks = 0;
  for (const PairKind kind : kinds) blocks += pairs.blocks(kind);
  budget.begin_traversal(blocks);
  for (const PairKind kind : kinds)
    visit_pairs(
        pairs, kind, kBlocksATask, std::vector<Found>(), budget,
        [&](std::vector<Found>& found, const IdPair* batch, std::size_t n) {
          const std::size_t before = found.size();
          visit(kind, batch, n, found);
          count += found.size() - before;
          if (found.size() >= Parts<Found>::kPart) parts[std::size_t(kind)].add(found);
        },
        [&](std::vector<Found>& found) { parts[std::size_t(kind)].add(found); },
        [&] { return count > most; });
  all.too_many = count > most;
  if (all.too_many) {
    for (Parts<Found>& of_kind : parts) of_kind.clear();
    return all;
  }
  const auto key = [&](const Found& f) {
    const IdPair ids = ids_of(f);
    return std::uint64_t(ids.a) << 32 | std::uint64_t(ids.b);
  };
  std::size_t total = 0;
  for (const Parts<Found>& of_kind : parts) total += of_kind.size();
  all.found.reserve(total);
  for (const PairKind kind : kinds) sort_within(budget, parts[std::size_t(kind)], key, all.found);
  return all;
}

}  // namespace onset
