// What this process holds of memory that C++ allocated.
#pragma once

#include <cstddef>
#include <cstdint>

namespace onset::tests {

// Measures from where it is made on.
class MemoryUse {
 public:
  MemoryUse();
  // The most that was held at once beyond what was held at the beginning.
  std::int64_t peak() const;

 private:
  std::int64_t before_;
};

// The n-th allocation of this thread from now on throws std::bad_alloc; 0: none does.
void fail_at_allocation(long n);

}  // namespace onset::tests
