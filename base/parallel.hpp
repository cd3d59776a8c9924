// Parallel loops, arenas and sorts; no other file includes TBB.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>
#include <tbb/task_arena.h>

#include <cstddef>
#include <memory>

#include "base/float_environment.hpp"

namespace onset {

// f(first, last) over [0, count) in chunks of about `grain`, in the current arena. Workers keep the
// floating-point environment that they were made in: each chunk has its own.
template <class F>
void parallel_ranges(std::size_t count, std::size_t grain, F&& f) {
  if (count <= grain) {
    if (count > 0) f(std::size_t(0), count);
    return;
  }
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, count, grain),
      [&](const tbb::blocked_range<std::size_t>& r) { in_float_environment(f, r.begin(), r.end()); });
}

// An arena for one call, out of those that earlier calls with as many threads gave back. This TBB frees no
// arena that ran a loop: one a call would leak.
class LentArena {
 public:
  explicit LentArena(int threads);
  ~LentArena();
  LentArena(const LentArena&) = delete;
  LentArena& operator=(const LentArena&) = delete;
  tbb::task_arena* operator->() const { return arena_.get(); }

 private:
  int threads_;
  std::unique_ptr<tbb::task_arena> arena_;
};

// f() in the caller's arena (threads == 0) or in one of at most `threads`, in the floating-point environment
// of all promises. A thread that waits inside takes on no other work of the caller's arena.
template <class F>
void in_arena(int threads, F&& f) {
  const auto alone = [&] { tbb::this_task_arena::isolate([&] { in_float_environment(f); }); };
  if (threads == 0) {
    alone();
  } else {
    const LentArena arena(threads);
    arena->execute(alone);
  }
}

// Returns how many threads the current arena may use.
inline int current_threads() { return tbb::this_task_arena::max_concurrency(); }

// A total order is required of `less`: the result is then independent of the number of threads. It compares
// integers, or doubles in the floating-point environment of whoever runs it.
template <class It, class Less>
void parallel_sort(It first, It last, Less less) {
  tbb::parallel_sort(first, last, less);
}

}  // namespace onset
