// Parallel loops, arenas and sorts; no other file includes TBB.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>
#include <tbb/task_arena.h>

#include <cstddef>

namespace onset {

// Calls f(first, last) on chunks of about `grain` that cover [0, count), in the current arena.
template <class F>
void parallel_ranges(std::size_t count, std::size_t grain, F&& f) {
  if (count <= grain) {
    if (count > 0) f(std::size_t(0), count);
    return;
  }
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                    [&](const tbb::blocked_range<std::size_t>& r) { f(r.begin(), r.end()); });
}

// Calls f() in the caller's arena where threads == 0, else in an arena of at most `threads` threads.
template <class F>
void in_arena(int threads, F&& f) {
  if (threads == 0) {
    f();
  } else {
    tbb::task_arena arena(threads);
    arena.execute(f);
  }
}

// Returns how many threads the current arena may use.
inline int current_threads() { return tbb::this_task_arena::max_concurrency(); }

// Sorts; `less` must be a total order, so that the result is the same for any number of threads.
template <class It, class Less>
void parallel_sort(It first, It last, Less less) {
  tbb::parallel_sort(first, last, less);
}

}  // namespace onset
