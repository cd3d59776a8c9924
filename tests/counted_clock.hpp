// A clock on which every look takes a second, so that what depends on time is the same in every run.
#pragma once

#include <atomic>
#include <cstdint>

#include "base/clock.hpp"

namespace onset::tests {

// While one lives, all clocks of the library count the looks at them.
class CountedClock {
 public:
  CountedClock() {
    looks_ = 0;
    time_source = [] { return double(looks_++); };
  }
  ~CountedClock() { time_source = steady_seconds; }
  CountedClock(const CountedClock&) = delete;
  CountedClock& operator=(const CountedClock&) = delete;

  std::int64_t looks() const { return looks_; }

 private:
  static inline std::atomic<std::int64_t> looks_{0};
};

}  // namespace onset::tests
