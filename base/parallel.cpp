#include "base/parallel.hpp"

#include <map>
#include <mutex>
#include <utility>
#include <vector>

namespace onset {
namespace {

// Arenas of one number of threads. `idle` has room for all that were made: to give one back allocates
// nothing.
struct Shelf {
  std::vector<std::unique_ptr<tbb::task_arena>> idle;
  std::size_t made = 0;
};

struct Arenas {
  std::mutex mutex;
  std::map<int, Shelf> shelves;  // by the number of threads
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
    Shelf& shelf = arenas().shelves[threads];
    if (!shelf.idle.empty()) {
      arena_ = std::move(shelf.idle.back());
      shelf.idle.pop_back();
    } else {
      shelf.idle.reserve(shelf.made + 1);
      ++shelf.made;
    }
  }
  if (!arena_) arena_ = std::make_unique<tbb::task_arena>(threads);
}

LentArena::~LentArena() {
  const std::lock_guard<std::mutex> lock(arenas().mutex);
  arenas().shelves[threads_].idle.push_back(std::move(arena_));
}

}  // namespace onset
