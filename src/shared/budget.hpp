// What a call may still spend: time, checks, the caller's patience. One for a call; any thread.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "base/clock.hpp"
#include "onset/options.hpp"
#include "onset/result.hpp"

namespace onset {

class Budget {
 public:
  // Calls Options::progress with 0.
  explicit Budget(const Options& options);

  // Whether the call must end; looks at the clock.
  bool spent();
  // A new traversal of so many blocks of pairs, and how many more of them are done: for the caller's progress.
  void begin_traversal(std::size_t blocks);
  void advance(std::size_t blocks);
  void add_checks(std::int64_t checks) { checks_ += checks; }
  // Between waves of work only, so that the answer does not depend on the order of work.
  void look_at_checks();

  bool counts_checks() const;
  // Time or cancellation: pairs then come a few at a time.
  bool is_watched() const;
  // Why the call must end; free while it need not.
  Outcome outcome() const { return outcome_.load(std::memory_order_relaxed); }
  // The share of the last traversal that is done, in [0, 1].
  double done() const;

 private:
  void end(Outcome why);
  void report();

  const Options& options_;
  const Clock clock_;
  std::atomic<Outcome> outcome_{Outcome::free};
  std::int64_t checks_ = 0;
  std::atomic<std::size_t> blocks_{0}, blocks_done_{0};
  std::atomic_flag reporting_ = ATOMIC_FLAG_INIT;
};

}  // namespace onset
