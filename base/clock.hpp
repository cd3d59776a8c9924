// A clock that returns the seconds since its construction.
#pragma once

#include <atomic>
#include <chrono>

namespace onset {

inline double steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Where all clocks look. Only tests set it, to a clock that counts the looks.
inline std::atomic<double (*)()> time_source{steady_seconds};

class Clock {
 public:
  double seconds() const { return now() - start_; }

 private:
  static double now() { return time_source.load(std::memory_order_relaxed)(); }

  double start_ = now();
};

}  // namespace onset
