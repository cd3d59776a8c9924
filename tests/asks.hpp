// A stop that says so at the n-th time that it is asked, and counts.
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>

#include "base/stop.hpp"

namespace onset::tests {

struct Asks {
  std::int64_t most = std::numeric_limits<std::int64_t>::max();
  std::atomic<std::int64_t> count{0};

  Asks() = default;
  explicit Asks(std::int64_t n) : most(n) {}
  Stop stop() {
    return {this, [](void* asks) { return static_cast<Asks*>(asks)->asked(); }};
  }

 private:
  bool asked() { return ++count > most; }
};

}  // namespace onset::tests
