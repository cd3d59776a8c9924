// One line on stderr for work that lasts longer than a second, when stderr is a terminal.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>

namespace app {

// Shows what is under way, its count when advance() is called, and the seconds since construction; clears the
// line when destroyed. A thread of its own redraws it, none where stderr is no terminal.
class Progress {
 public:
  explicit Progress(std::string what);
  ~Progress();
  Progress(const Progress&) = delete;
  void advance() { count_.fetch_add(1, std::memory_order_relaxed); }

 private:
  void redraw();
  std::string what_;
  std::atomic<std::int64_t> count_{0};
  std::mutex mutex_;
  std::condition_variable stop_;
  bool stopped_ = false;
  std::thread thread_;
};

}  // namespace app
