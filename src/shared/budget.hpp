// What a call may still spend: time, checks, and the caller's patience.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "base/clock.hpp"
#include "base/stop.hpp"
#include "onset/options.hpp"
#include "onset/result.hpp"

namespace onset {

// Where time or the caller can end a call, no more pairs than this are decided between two looks: a hard one
// takes tens of microseconds.
inline constexpr std::size_t kWatchedPairs = 16;

// The budget of one call. Any thread may ask it, which calls the caller's progress when that is due: not
// while a lock is held.
class Budget {
 public:
  // Calls Options::progress with 0.
  explicit Budget(const Options& options);

  // Says whether the call must end; looks at the clock.
  bool spent();
  // Says whether time or the caller ended the call, whatever the checks say: nothing more may then be done to
  // what was found. Looks at the clock.
  bool interrupted();
  // Ask spent() and interrupted(); never where neither time nor the caller can end the call.
  Stop stop();
  Stop interruption();

  // Begin a traversal of so many blocks of pairs, and say that so many more are done, which reports progress.
  void begin_traversal(std::size_t blocks);
  void advance(std::size_t blocks);
  void add_checks(std::int64_t checks) { checks_ += checks; }
  // Ends the call where its checks are spent. Called between waves of work only, so that the answer does not
  // depend on the order of work.
  void look_at_checks();

  // Ends the call, whose memory_limit does not hold what it needs.
  void run_out_of_memory() { end(Outcome::out_of_memory); }
  // Ends the call, which answers with an exception of the caller's: other threads need not finish.
  void abandon() { interrupt(Outcome::cancelled); }

  bool counts_checks() const;
  // Says whether time or the caller can end the call: pairs then come a few at a time.
  bool is_watched() const { return watched_; }
  // Returns why the call must end; free while it need not.
  Outcome outcome() const { return outcome_.load(std::memory_order_relaxed); }
  // Returns the share of the last traversal that is done, in [0, 1].
  double done() const;

 private:
  void look();
  void end(Outcome why);
  void interrupt(Outcome why);
  void report();

  const Options& options_;
  const Clock clock_;
  const bool watched_;
  std::atomic<Outcome> outcome_{Outcome::free};
  std::atomic<bool> interrupted_{false};
  std::int64_t checks_ = 0;
  std::atomic<std::size_t> blocks_{0}, blocks_done_{0};
  std::atomic_flag reporting_ = ATOMIC_FLAG_INIT;
  std::atomic<double> reported_at_{0};
};

}  // namespace onset
