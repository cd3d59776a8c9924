// Onset's own threads where no thread can be had, and where the process ends.
#include <sys/resource.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <thread>

#include "base/parallel.hpp"
#include "base/threads/thread_pool.hpp"
#include "tests/base/child_process.hpp"
#include "tests/catch.hpp"

// Sanitizers need more memory than a limit would leave them.
#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define ONSET_TEST_LIMITED_MEMORY
#endif
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#undef ONSET_TEST_LIMITED_MEMORY
#endif
#endif

using namespace onset;
using tests::in_child_process;

namespace {

// 1 + ... + 1000 with up to four threads; counts the chunks that other threads than this one ran.
bool sums(std::atomic<int>& by_others) {
  std::atomic<int> sum{0};
  const auto caller = std::this_thread::get_id();
  in_arena(4, [&] {
    parallel_ranges(1000, 1, [&](std::size_t first, std::size_t last) {
      if (std::this_thread::get_id() != caller) ++by_others;
      for (; first < last; ++first) sum += int(first) + 1;
    });
  });
  return sum == 500500;
}

}  // namespace

TEST_CASE("a pool that was stopped leaves all work to who calls", "[unit][parallel]") {
  CHECK(in_child_process([] {
          std::atomic<int> by_others{0};
          ThreadPool::instance().stop();
          return sums(by_others) && by_others == 0 ? 7 : 1;
        }) == 7);
}

#ifdef ONSET_TEST_LIMITED_MEMORY
TEST_CASE("where no thread can be made the caller works alone", "[unit][parallel]") {
  CHECK(in_child_process([] {
          // No room for the stack of a thread.
          long pages = 0;
          std::ifstream("/proc/self/statm") >> pages;
          const rlim_t bytes = rlim_t(pages) * rlim_t(sysconf(_SC_PAGESIZE)) + (1 << 20);
          const rlimit limit{bytes, bytes};
          if (setrlimit(RLIMIT_AS, &limit) != 0) return 2;
          std::atomic<int> by_others{0};
          return sums(by_others) && by_others == 0 ? 7 : 1;
        }) == 7);
}
#endif

TEST_CASE("of two exceptions at once one leaves the loop", "[unit][parallel]") {
  std::atomic<int> inside{0};
  const auto both_throw = [&] {
    parallel_ranges(2, 1, [&](std::size_t first, std::size_t) {
      ++inside;
      while (inside < 2) std::this_thread::yield();
      throw first;
    });
  };
  std::size_t thrown = 2;
  try {
    in_arena(2, both_throw);
  } catch (std::size_t chunk) {
    thrown = chunk;
  }
  CHECK(inside == 2);
  CHECK(thrown < 2);
}

TEST_CASE("a process may end while a thread of the pool is at work", "[unit][parallel]") {
  CHECK(in_child_process([] {
          std::atomic<bool> working{false};
          const auto caller = std::this_thread::get_id();
          in_arena(2, [&] {
            parallel_ranges(2, 1, [&](std::size_t, std::size_t) {
              if (std::this_thread::get_id() == caller) {
                while (!working) std::this_thread::yield();
                std::exit(7);
              }
              working = true;
              std::this_thread::sleep_for(std::chrono::seconds(60));
            });
          });
          return 1;
        }) == 7);
}
