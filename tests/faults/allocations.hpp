// A memory that is never empty where nobody wrote, and runs out where a test says so: operator new of the
// whole program, in all of its forms.
#pragma once

#include <cstdint>

namespace onset::tests {

// Blocks that were made and not freed, by any thread.
std::int64_t live_blocks();
// The most bytes, those that malloc rounds up to, that all blocks had together since the last call of this.
std::int64_t most_bytes_since();
// Whether there are at most so many, now or within a second: a worker that was among the last may free what
// it had of a task a little after the call has returned.
bool no_more_blocks_than(std::int64_t most);

// Which allocations fail:
// - once: one.
// - lasting: all from that one on.
// - elsewhere: one of those that other threads ask for, which alone are counted; this thread waits a little
//   at each of its own, so that others get some of the work.
enum class Shortage { once, lasting, elsewhere };

// While one lives, the k-th allocation of any thread from now on (k = 1 is the next) throws std::bad_alloc;
// its nothrow form gives null. For k = 0 none fails: they are counted.
class FailingAllocations {
 public:
  FailingAllocations(std::int64_t k, Shortage shortage);
  ~FailingAllocations();
  FailingAllocations(const FailingAllocations&) = delete;
  FailingAllocations& operator=(const FailingAllocations&) = delete;
  // How many there were so far, failed ones among them.
  std::int64_t count() const;
  bool failed() const;
  // Whether one failed that this thread did not ask for.
  bool failed_on_other_thread() const;
};

}  // namespace onset::tests
