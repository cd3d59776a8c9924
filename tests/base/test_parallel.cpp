// What both back ends of base/parallel.hpp promise; the build makes a program for each.
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <random>
#include <stdexcept>
#include <thread>
#include <vector>

#include "base/parallel.hpp"
#include "tests/base/child_process.hpp"
#include "tests/catch.hpp"

#if defined(__SSE2__)
#include <immintrin.h>
#endif

using namespace onset;
using tests::in_child_process;

namespace {

// Four threads even where there are fewer cores.
const tbb::global_control four_workers(tbb::global_control::max_allowed_parallelism, 4);

int threads_of_this_process() {
  int count = 0;
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) (void)task, ++count;
  return count;
}

// 1 + ... + n, each added by a chunk of its own.
std::size_t sum_up_to(std::size_t n) {
  std::atomic<std::size_t> sum{0};
  parallel_ranges(n, 1, [&](std::size_t first, std::size_t last) {
    for (; first < last; ++first) sum += first + 1;
  });
  return sum;
}

// Waits until `count` is reached, but not for ever.
bool wait_for(const std::atomic<int>& count, int wanted) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (count < wanted && std::chrono::steady_clock::now() < end) std::this_thread::yield();
  return count >= wanted;
}

}  // namespace

TEST_CASE("a loop visits every index once", "[unit][parallel]") {
  for (int threads : {0, 1, 2, 3, 4})
    for (std::size_t count : {0, 1, 2, 7, 64, 65, 1000, 10007})
      for (std::size_t grain : {1, 2, 64, 1000, 20000}) {
        CAPTURE(threads, count, grain);
        std::vector<std::atomic<int>> visits(count);
        in_arena(threads, [&] {
          parallel_ranges(count, grain, [&](std::size_t first, std::size_t last) {
            for (; first < last; ++first) ++visits[first];
          });
        });
        CHECK(std::all_of(visits.begin(), visits.end(), [](const std::atomic<int>& n) { return n == 1; }));
      }
}

TEST_CASE("an arena of n threads has n at most, and the second one comes", "[unit][parallel]") {
  for (int threads : {4, 1, 2, 3}) {
    CAPTURE(threads);
    std::atomic<int> inside{0}, most{0}, came{0};
    const auto caller = std::this_thread::get_id();
    const auto work = [&](std::size_t, std::size_t) {
      const int now = ++inside;
      for (int before = most; before < now && !most.compare_exchange_weak(before, now);) {
      }
      std::this_thread::sleep_for(std::chrono::microseconds(200));
      --inside;
    };
    in_arena(threads, [&] {
      CHECK(current_threads() == threads);
      parallel_ranges(64, 1, [&](std::size_t first, std::size_t) {
        if (std::this_thread::get_id() != caller) came = 1;
        if (first == 0 && threads > 1) wait_for(came, 1);
        parallel_ranges(4, 1, work);
      });
    });
    CHECK(most <= threads);
    CHECK(came == (threads > 1));
  }
}

TEST_CASE("outside any arena a loop has the threads of the hardware", "[unit][parallel]") {
  CHECK(current_threads() >= 1);
  CHECK(sum_up_to(1000) == 500500);
  in_arena(0, [] { CHECK(sum_up_to(1000) == 500500); });
  int before = 0;
  std::thread([&] { before = current_threads(); }).join();
  CHECK(current_threads() == before);
}

TEST_CASE("an exception leaves its loop when no chunk runs any more", "[unit][parallel]") {
  for (int threads : {1, 2, 4})
    for (int round = 0; round < 20; ++round) {
      CAPTURE(threads, round);
      std::atomic<int> inside{0};
      const auto loop = [&] {
        parallel_ranges(200, 1, [&](std::size_t first, std::size_t last) {
          for (; first < last; ++first) {
            ++inside;
            std::this_thread::sleep_for(std::chrono::microseconds(20));
            --inside;
            if (first % 50 == 17) throw std::runtime_error("chunk");
          }
        });
      };
      CHECK_THROWS_WITH(in_arena(threads, loop), "chunk");
      CHECK(inside == 0);
      in_arena(threads, [&] { CHECK(sum_up_to(100) == 5050); });
    }
}

TEST_CASE("loops and calls may be made from inside a loop", "[unit][parallel]") {
  for (int threads : {1, 2, 4})
    for (int inner : {0, 1, 2, 3}) {
      CAPTURE(threads, inner);
      std::atomic<int> right{0}, wrong_threads{0};
      in_arena(threads, [&] {
        parallel_ranges(40, 1, [&](std::size_t first, std::size_t last) {
          for (; first < last; ++first) {
            right += sum_up_to(50) == 1275;
            in_arena(inner, [&] {
              if (inner > 0 && current_threads() != inner) ++wrong_threads;
              right += sum_up_to(60) == 1830;
            });
            if (current_threads() != threads) ++wrong_threads;
          }
        });
      });
      CHECK(right == 80);
      CHECK(wrong_threads == 0);
    }
}

TEST_CASE("a thread that waits inside a call takes on no other work", "[unit][parallel]") {
  thread_local bool inside = false;
  for (int inner : {0, 2, 4}) {
    CAPTURE(inner);
    std::atomic<int> intruders{0};
    in_arena(4, [&] {
      parallel_ranges(100, 1, [&](std::size_t, std::size_t) {
        if (inside) ++intruders;
        inside = true;
        in_arena(inner, [&] {
          parallel_ranges(8, 1, [](std::size_t, std::size_t) {
            std::this_thread::sleep_for(std::chrono::microseconds(50));
          });
        });
        inside = false;
      });
    });
    CHECK(intruders == 0);
  }
}

TEST_CASE("many calls make no more threads than a few", "[unit][parallel]") {
  for (int i = 0; i < 2000; ++i) in_arena(1 + i % 4, [] { CHECK(sum_up_to(100) == 5050); });
  // One more, for a sanitizer's own.
  CHECK(threads_of_this_process() <= std::max(4, int(std::thread::hardware_concurrency())) + 1);
}

TEST_CASE("several threads may call at once", "[unit][parallel]") {
  std::atomic<int> wrong{0};
  std::vector<std::thread> hosts;
  for (int i = 0; i < 8; ++i)
    hosts.emplace_back([&, i] {
      for (int round = 0; round < 100; ++round) in_arena(i % 5, [&] { wrong += sum_up_to(100) != 5050; });
    });
  for (std::thread& host : hosts) host.join();
  CHECK(wrong == 0);
}

TEST_CASE("a child process may call, whatever its parent did", "[unit][parallel]") {
  const auto call = [] {
    std::size_t sum = 0;
    for (int threads : {1, 2, 4}) in_arena(threads, [&] { sum += sum_up_to(1000); });
    return sum == 3 * 500500 ? 7 : 1;
  };
  CHECK(call() == 7);
  for (int round = 0; round < 5; ++round) CHECK(in_child_process(call) == 7);
  CHECK(call() == 7);
}

#if defined(__SSE2__)
TEST_CASE("every chunk has the floating-point environment of the library", "[unit][parallel]") {
  const unsigned host = _mm_getcsr(), downward = 0x3f80;
  std::atomic<int> wrong{0};
  in_arena(4, [&] {
    parallel_ranges(1000, 1, [&](std::size_t, std::size_t) { _mm_setcsr(downward); });
    parallel_ranges(1000, 1, [&](std::size_t, std::size_t) { wrong += (_mm_getcsr() & ~0x3fu) != 0x1f80; });
  });
  CHECK(wrong == 0);
  CHECK(_mm_getcsr() == host);
}
#endif

TEST_CASE("a thread that waits for a host's parallel work takes on no chunk of the loop",
          "[unit][parallel][tbb]") {
  thread_local bool inside = false;
  std::atomic<int> intruders{0};
  in_arena(4, [&] {
    parallel_ranges(2000, 1, [&](std::size_t, std::size_t) {
      if (inside) ++intruders;
      isolated([&] {
        inside = true;
        tbb::parallel_for(0, 16, [](int) { std::this_thread::sleep_for(std::chrono::microseconds(5)); });
        inside = false;
      });
    });
  });
  CHECK(intruders == 0);
}

TEST_CASE("sorting in parallel is sorting", "[unit][parallel]") {
  std::mt19937 random(5);
  for (int threads : {1, 2, 3, 4, 7})
    for (std::size_t count : {0, 1, 2, 100, 4000, 4001, 9973, 50001})
      for (int keys : {3, 1 << 30}) {
        CAPTURE(threads, count, keys);
        std::vector<std::pair<int, int>> items(count);
        for (std::size_t i = 0; i < count; ++i) items[i] = {int(random() % unsigned(keys)), int(i)};
        std::vector<std::pair<int, int>> sorted = items;
        std::sort(sorted.begin(), sorted.end());
        in_arena(threads, [&] { parallel_sort(items.begin(), items.end(), std::less<>()); });
        CHECK((items == sorted));
      }
}
