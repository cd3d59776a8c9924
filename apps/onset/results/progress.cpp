#include "onset/results/progress.hpp"

#include <unistd.h>

#include <chrono>
#include <cstdio>

namespace app {

Progress::Progress(std::string what) : what_(std::move(what)) {
  if (isatty(STDERR_FILENO)) thread_ = std::thread([this] { redraw(); });
}

Progress::~Progress() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopped_ = true;
  }
  stop_.notify_one();
  thread_.join();
}

void Progress::redraw() {
  using namespace std::chrono_literals;
  const auto start = std::chrono::steady_clock::now();
  bool shown = false;
  std::unique_lock<std::mutex> lock(mutex_);
  for (auto wait = 1000ms; !stop_.wait_for(lock, wait, [this] { return stopped_; }); wait = 200ms) {
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const long long count = count_.load(std::memory_order_relaxed);
    if (count > 0)
      std::fprintf(stderr, "\r%s: %lld, %.0f s\033[K", what_.c_str(), count, seconds);
    else
      std::fprintf(stderr, "\r%s: %.0f s\033[K", what_.c_str(), seconds);
    std::fflush(stderr);
    shown = true;
  }
  if (shown) std::fputs("\r\033[K", stderr);
}

}  // namespace app
