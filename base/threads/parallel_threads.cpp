// The back end that needs no other library: threads of onset's own.
#include <algorithm>
#include <thread>

#include "base/parallel.hpp"
#include "base/threads/thread_pool.hpp"

namespace onset {
namespace {

// Of the call that this thread works on.
thread_local Team* current = nullptr;

struct Joined {
  explicit Joined(Team* team) : before(current) { current = team; }
  ~Joined() { current = before; }
  Team* const before;
};

int threads_of_hardware() { return std::max(1, int(std::thread::hardware_concurrency())); }

}  // namespace

namespace backend {

void run_ranges(std::size_t count, std::size_t grain, FunctionRef<std::size_t, std::size_t> f) {
  Team alone(current == nullptr ? threads_of_hardware() : 1);
  Team& team = current == nullptr ? alone : *current;
  const auto joined = [&](std::size_t first, std::size_t last) {
    const Joined team_of_loop(&team);
    f(first, last);
  };
  Loop loop(team, count, grain, FunctionRef<std::size_t, std::size_t>(joined));
  if (team.threads > 1) ThreadPool::instance().open(loop);
  loop.work();
  if (team.threads > 1) ThreadPool::instance().close(loop);
  loop.finish();
}

void run_in_arena(int threads, FunctionRef<> f) {
  if (threads == 0 && current != nullptr) return f();
  Team team(threads == 0 ? threads_of_hardware() : threads);
  const Joined joined(&team);
  f();
}

// Nobody who waits here ever takes on other work.
void run_isolated(FunctionRef<> f) { f(); }
void run_for_host(FunctionRef<> f) { f(); }

}  // namespace backend

int current_threads() { return current == nullptr ? threads_of_hardware() : current->threads; }

}  // namespace onset
