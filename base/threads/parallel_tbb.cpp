// The back end that shares a host's threads: oneTBB.
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <list>
#include <map>
#include <mutex>

#include "base/parallel.hpp"

namespace onset {
namespace {

using Arenas = std::list<tbb::task_arena>;

struct IdleArenas {
  std::mutex mutex;
  std::map<int, Arenas> of;  // so many threads
};

// Never destroyed: calls may be made until the process ends.
IdleArenas& idle_arenas() {
  static IdleArenas& all = *new IdleArenas;
  return all;
}

// An arena for one call, out of those that earlier calls with as many threads gave back. This TBB frees no
// arena that ran a loop: one a call would leak.
class LentArena {
 public:
  explicit LentArena(int threads) {
    const std::lock_guard<std::mutex> lock(idle_arenas().mutex);
    home_ = &idle_arenas().of[threads];
    if (home_->empty())
      mine_.emplace_back(threads);
    else
      mine_.splice(mine_.begin(), *home_, home_->begin());
  }
  // A splice allocates nothing, so it cannot fail. An arena for which there was no memory would keep its next
  // user waiting for ever.
  ~LentArena() {
    const std::lock_guard<std::mutex> lock(idle_arenas().mutex);
    if (mine_.front().is_active()) home_->splice(home_->begin(), mine_);
  }
  LentArena(const LentArena&) = delete;
  LentArena& operator=(const LentArena&) = delete;
  tbb::task_arena* operator->() { return &mine_.front(); }

 private:
  Arenas mine_;  // one
  Arenas* home_;
};

}  // namespace

namespace backend {

void run_ranges(std::size_t count, std::size_t grain, FunctionRef<std::size_t, std::size_t> f) {
  // In a task group of the host's that is cancelled, chunks would be left out without a word.
  tbb::task_group_context own(tbb::task_group_context::isolated);
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, count, grain),
      [=](const tbb::blocked_range<std::size_t>& r) { f(r.begin(), r.end()); }, own);
}

void run_isolated(FunctionRef<> f) {
  tbb::this_task_arena::isolate([=] { f(); });
}

// What the host cancels in there is a group of one task.
void run_for_host(FunctionRef<> f) {
  tbb::this_task_arena::isolate([=] {
    tbb::task_group_context own(tbb::task_group_context::isolated);
    tbb::parallel_for(
        0, 1, [=](int) { f(); }, own);
  });
}

void run_in_arena(int threads, FunctionRef<> f) {
  if (threads == 0) return run_isolated(f);
  LentArena arena(threads);
  arena->execute([=] { run_isolated(f); });
}

}  // namespace backend

int current_threads() { return tbb::this_task_arena::max_concurrency(); }

}  // namespace onset
