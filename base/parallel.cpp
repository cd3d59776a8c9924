#include "base/parallel.hpp"

#include <map>
#include <mutex>
#include <utility>
#include <vector>

namespace onset {
namespace {

struct Arenas {
  std::mutex mutex;
  std::map<int, std::vector<std::unique_ptr<tbb::task_arena>>> idle;  // by the number of threads
};

// Never destroyed: calls may be made until the process ends.
Arenas& arenas() {
  static Arenas& all = *new Arenas;
  return all;
}

}  // namespace

LentArena::LentArena(int threads) : threads_(threads) {
  {
    const std::lock_guard<std::mutex> lock(arenas().mutex);
    auto& idle = arenas().idle[threads];
    if (!idle.empty()) {
      arena_ = std::move(idle.back());
      idle.pop_back();
    }
  }
  if (!arena_) arena_ = std::make_unique<tbb::task_arena>(threads);
}

LentArena::~LentArena() {
  const std::lock_guard<std::mutex> lock(arenas().mutex);
  arenas().idle[threads_].push_back(std::move(arena_));
}

}  // namespace onset
