// Parallel loops, arenas and sorts. One of two back ends defines them, as the build says (ONSET_THREADS in
// docs/building.md): threads/parallel_tbb.cpp, the only file that includes TBB, or
// threads/parallel_threads.cpp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <mutex>

#include "base/float_environment.hpp"
#include "base/function_ref.hpp"

namespace onset {

namespace backend {
void run_ranges(std::size_t count, std::size_t grain, FunctionRef<std::size_t, std::size_t> f);
void run_in_arena(int threads, FunctionRef<> f);
void run_isolated(FunctionRef<> f);
void run_for_host(FunctionRef<> f);
}  // namespace backend

// f(first, last) over [0, count) in chunks of about `grain`, in the current arena. An exception of f leaves
// the loop, once no chunk runs any more. Workers keep the floating-point environment that they were made in:
// each chunk has its own.
template <class F>
void parallel_ranges(std::size_t count, std::size_t grain, F&& f) {
  if (count <= grain) {
    if (count > 0) f(std::size_t(0), count);
    return;
  }
  const auto chunk = [&](std::size_t first, std::size_t last) { in_float_environment(f, first, last); };
  backend::run_ranges(count, grain, FunctionRef<std::size_t, std::size_t>(chunk));
}

// Returns join(... join(none, f(first, last)) ...) over chunks of [0, count). The chunks come in any order,
// so that `join` must not depend on it.
template <class T, class F, class Join>
T parallel_reduce(std::size_t count, std::size_t grain, T none, F&& f, Join&& join) {
  std::mutex mutex;
  parallel_ranges(count, grain, [&](std::size_t first, std::size_t last) {
    const T mine = f(first, last);
    const std::lock_guard<std::mutex> lock(mutex);
    none = join(none, mine);
  });
  return none;
}

// f() in the caller's arena (threads == 0) or in one of at most `threads`, in the floating-point environment
// of all promises. A thread that waits inside takes on no other work of the caller's arena. An arena switches
// to the environment that it was made in, and back without the flags: it is not to see that of the host.
template <class F>
void in_arena(int threads, F&& f) {
  in_float_environment([&] {
    const auto alone = [&] { in_float_environment(f); };
    backend::run_in_arena(threads, FunctionRef<>(alone));
  });
}

// f(), with parallel work: a thread that waits for it takes on no other work of the arena.
template <class F>
void isolated(F&& f) {
  backend::run_isolated(FunctionRef<>(f));
}

// f() is the host's: it may run parallel work, during which this thread takes on no other work of this call,
// whose tasks would else pile up on its stack. What it does to the task group that it finds itself in, or to
// the floating-point environment, ends with it.
template <class F>
void call_host(F&& f) {
  const auto alone = [&] { in_float_environment(f); };
  backend::run_for_host(FunctionRef<>(alone));
}

// Returns how many threads the current arena may use.
int current_threads();

// Returns into how many pieces, a power of two, a sort of so many items is divided.
inline std::size_t sort_pieces(std::size_t count) {
  constexpr std::size_t kFew = 2000, kMostPieces = 64;
  std::size_t pieces = 1;
  while (pieces < kMostPieces && pieces < std::size_t(current_threads()) && count / pieces > kFew)
    pieces *= 2;
  return pieces;
}

// A total order is required of `less`: the result is then independent of the number of threads. Calls without
// options sort in the caller's arena: they too take on no other work of it.
template <class It, class Less>
void parallel_sort(It first, It last, Less less) {
  const std::size_t count = std::size_t(last - first), pieces = sort_pieces(count);
  if (pieces == 1) return std::sort(first, last, less);
  const auto at = [&](std::size_t piece) {
    return first + typename std::iterator_traits<It>::difference_type(count / pieces * piece +
                                                                      count % pieces * piece / pieces);
  };
  isolated([&] {
    parallel_ranges(pieces, 1, [&](std::size_t piece, std::size_t end) {
      for (; piece < end; ++piece) std::sort(at(piece), at(piece + 1), less);
    });
    for (std::size_t width = 1; width < pieces; width *= 2)
      parallel_ranges(pieces / (2 * width), 1, [&](std::size_t merge, std::size_t end) {
        for (; merge < end; ++merge)
          std::inplace_merge(at(2 * merge * width), at((2 * merge + 1) * width), at((2 * merge + 2) * width),
                             less);
      });
  });
}

}  // namespace onset
