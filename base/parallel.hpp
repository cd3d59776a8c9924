// The only place that includes TBB.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>
#include <tbb/task_arena.h>

#include <cstddef>

namespace onset {

// f(first, last) over [0, count) in chunks of about `grain`, in the current arena.
template <class F>
void parallel_ranges(std::size_t count, std::size_t grain, F&& f) {
  if (count <= grain) {
    if (count > 0) f(std::size_t(0), count);
    return;
  }
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                    [&](const tbb::blocked_range<std::size_t>& r) { f(r.begin(), r.end()); });
}

// f() in the caller's arena (threads == 0) or in one of at most `threads`.
template <class F>
void in_arena(int threads, F&& f) {
  if (threads == 0) {
    f();
  } else {
    tbb::task_arena arena(threads);
    arena.execute(f);
  }
}

inline int current_threads() { return tbb::this_task_arena::max_concurrency(); }

// A total order is required of `less`: the result is then independent of the number of threads.
template <class It, class Less>
void parallel_sort(It first, It last, Less less) {
  tbb::parallel_sort(first, last, less);
}

}  // namespace onset
