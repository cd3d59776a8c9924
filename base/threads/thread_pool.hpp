// Threads of the library's own, for builds without TBB: they sleep until a loop wants help.
//
// A thread that waits for a loop takes on no other work, and every loop ends without help, so that loops may
// be nested, and made from several threads at once.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <list>
#include <mutex>
#include <thread>

#include "base/function_ref.hpp"

namespace onset {

// Those who work on one call: whoever made it and `threads` - 1 helpers at most.
struct Team {
  explicit Team(int all) : threads(all) {}
  const int threads;
  int helpers = 0;  // under the pool's lock
};

// One loop, on the stack of the thread that runs it.
class Loop {
 public:
  Loop(Team& its_team, std::size_t count, std::size_t grain, FunctionRef<std::size_t, std::size_t> f)
      : team(its_team), chunks((count + grain - 1) / grain), count_(count), grain_(grain), f_(f) {}

  Team& team;
  const std::size_t chunks;

  bool has_work() const { return next_.load(std::memory_order_relaxed) < chunks; }
  // Takes chunks until none is left; the first exception leaves the rest out.
  void work() noexcept;
  // Throws it, once nobody works any more.
  void finish() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  friend class ThreadPool;
  const std::size_t count_, grain_;
  const FunctionRef<std::size_t, std::size_t> f_;
  std::atomic<std::size_t> next_{0};  // chunk
  std::atomic<bool> failed_{false};
  std::exception_ptr error_;  // of whoever set failed_
  // Under the pool's lock.
  int helpers_ = 0;
  std::condition_variable left_;  // the last helper
  Loop* next_open_ = nullptr;
};

class ThreadPool {
 public:
  // The one of this process, never destroyed: calls may be made until it ends.
  static ThreadPool& instance();

  // Invites helpers to a loop, and makes threads where the process has fewer than this loop may use: loops at
  // the same time share them. Where none can be had, nobody comes.
  void open(Loop& loop) noexcept;
  // Lets nobody in any more, and waits for those inside.
  void close(Loop& loop) noexcept;
  // Ends the threads that are idle, and makes no more: calls go on without help.
  void stop() noexcept;

 private:
  struct Worker {
    std::thread thread;
    bool idle = true;
  };
  void add_worker();
  void run(Worker& self) noexcept;
  Loop* wants_help() const;

  // Around a fork the forking thread holds the lock; in the child there is no worker.
  static void before_fork();
  static void in_parent();
  static void in_child();

  std::mutex mutex_;
  std::condition_variable work_;
  Loop* open_ = nullptr;  // a list
  std::list<Worker> workers_;
  int idle_ = 0;
  bool stopped_ = false;
};

}  // namespace onset
