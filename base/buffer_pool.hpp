// What one call on a mesh leaves for the next: memory, and what it found out that may hold again.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>

namespace onset {

// Each slot holds at most one object that nobody uses: who takes it has it alone.
class BufferPool {
 public:
  using Slot = std::size_t;
  static constexpr Slot kSlots = 4;

  template <class T>
  std::shared_ptr<T> take(Slot slot) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return std::static_pointer_cast<T>(std::exchange(slots_[slot], nullptr));
  }
  void give_back(Slot slot, std::shared_ptr<void> object) {
    const std::lock_guard<std::mutex> lock(mutex_);
    slots_[slot].swap(object);  // the old one goes after the lock
  }
  void clear() {
    for (Slot slot = 0; slot < kSlots; ++slot) give_back(slot, nullptr);
  }

 private:
  std::mutex mutex_;
  std::array<std::shared_ptr<void>, kSlots> slots_;
};

}  // namespace onset
