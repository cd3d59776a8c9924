#include "base/threads/thread_pool.hpp"

#include <algorithm>
#include <new>

#if defined(__unix__) || defined(__APPLE__)
#include <pthread.h>
#endif

namespace onset {
namespace {

// More are not made where the hardware has no more, whatever calls ask for.
constexpr int kMostWorkers = 63;

int most_workers() {
  static const int most = std::max(kMostWorkers, int(std::thread::hardware_concurrency()) - 1);
  return most;
}

// When the process ends, or a library that holds this is unloaded, no thread may sleep in its code.
struct AtEnd {
  ~AtEnd() { ThreadPool::instance().stop(); }
} at_end;

}  // namespace

void Loop::work() noexcept {
  for (;;) {
    const std::size_t chunk = next_.fetch_add(1, std::memory_order_relaxed);
    if (chunk >= chunks) return;
    const std::size_t first = chunk * grain_;
    try {
      f_(first, std::min(first + grain_, count_));
    } catch (...) {
      if (!failed_.exchange(true)) error_ = std::current_exception();
      next_.store(chunks, std::memory_order_relaxed);
    }
  }
}

ThreadPool& ThreadPool::instance() {
  static ThreadPool& pool = *[] {
    ThreadPool* made = new ThreadPool;
#if defined(__unix__) || defined(__APPLE__)
    pthread_atfork(before_fork, in_parent, in_child);
#endif
    return made;
  }();
  return pool;
}

void ThreadPool::before_fork() { instance().mutex_.lock(); }
void ThreadPool::in_parent() { instance().mutex_.unlock(); }
// What the threads of the parent left, their handles among it, is not destroyed but forgotten.
void ThreadPool::in_child() { new (&instance()) ThreadPool; }

Loop* ThreadPool::wants_help() const {
  for (Loop* loop = open_; loop != nullptr; loop = loop->next_open_)
    if (loop->has_work() && loop->team.helpers < loop->team.threads - 1) return loop;
  return nullptr;
}

void ThreadPool::add_worker() {
  Worker& worker = workers_.emplace_back();
  try {
    worker.thread = std::thread([this, &worker] { run(worker); });
  } catch (...) {
    workers_.pop_back();
    throw;
  }
  ++idle_;
}

void ThreadPool::run(Worker& self) noexcept {
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;) {
    Loop* loop = nullptr;
    work_.wait(lock, [&] { return stopped_ || (loop = wants_help()) != nullptr; });
    if (loop == nullptr) return;
    self.idle = false;
    --idle_;
    ++loop->helpers_, ++loop->team.helpers;
    lock.unlock();
    loop->work();
    lock.lock();
    --loop->team.helpers;
    if (--loop->helpers_ == 0) loop->left_.notify_one();  // under the lock: then the loop may be gone
    ++idle_;
    self.idle = true;
  }
}

void ThreadPool::open(Loop& loop) noexcept {
  const int wanted = int(std::min(std::size_t(loop.team.threads - 1), loop.chunks - 1));
  const int most = std::min(loop.team.threads - 1, most_workers());
  const std::lock_guard<std::mutex> lock(mutex_);
  if (stopped_) return;
  loop.next_open_ = open_;
  open_ = &loop;
  try {
    while (idle_ < wanted && int(workers_.size()) < most) add_worker();
  } catch (...) {  // no memory, or no thread: fewer will do
  }
  for (int i = 0; i < wanted; ++i) work_.notify_one();
}

void ThreadPool::close(Loop& loop) noexcept {
  std::unique_lock<std::mutex> lock(mutex_);
  for (Loop** at = &open_; *at != nullptr; at = &(*at)->next_open_)
    if (*at == &loop) {
      *at = loop.next_open_;
      break;
    }
  loop.left_.wait(lock, [&] { return loop.helpers_ == 0; });
}

void ThreadPool::stop() noexcept {
  std::list<Worker> asleep;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopped_ = true;
    for (auto worker = workers_.begin(); worker != workers_.end();) {
      const auto next = std::next(worker);
      if (worker->idle)
        asleep.splice(asleep.end(), workers_, worker);
      else
        worker->thread.detach();  // in a callback that ends the process, or in a thread that outlives main
      worker = next;
    }
  }
  work_.notify_all();
  for (Worker& worker : asleep) worker.thread.join();
}

}  // namespace onset
