// Containers for what one call leaves for the next: objects to take over, and objects to share.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>

#include "base/assert.hpp"

namespace onset {

// Holds at most one unused object a slot; whoever takes it has it alone. T may be incomplete here.
template <class T, std::size_t kSlots>
class BufferPool {
 public:
  std::shared_ptr<T> take(std::size_t slot) {
    ONSET_ASSERT(slot < kSlots);
    const std::lock_guard<std::mutex> lock(mutex_);
    return std::exchange(slots_[slot], nullptr);
  }
  void give_back(std::size_t slot, std::shared_ptr<T> object) {
    ONSET_ASSERT(slot < kSlots);
    const std::lock_guard<std::mutex> lock(mutex_);
    slots_[slot].swap(object);  // the old object is destroyed after the lock
  }
  void clear() {
    for (std::size_t slot = 0; slot < kSlots; ++slot) give_back(slot, nullptr);
  }

 private:
  std::mutex mutex_;
  std::array<std::shared_ptr<T>, kSlots> slots_;
};

// Holds the latest immutable object a slot; whoever got an earlier one keeps it. T may be incomplete here.
template <class T, std::size_t kSlots = 1>
class SharedCache {
 public:
  std::shared_ptr<const T> get(std::size_t slot = 0) const {
    ONSET_ASSERT(slot < kSlots);
    const std::lock_guard<std::mutex> lock(mutex_);
    return slots_[slot];
  }
  void put(std::shared_ptr<const T> object, std::size_t slot = 0) {
    ONSET_ASSERT(slot < kSlots);
    const std::lock_guard<std::mutex> lock(mutex_);
    slots_[slot].swap(object);  // the old object is destroyed after the lock
  }
  void clear() {
    for (std::size_t slot = 0; slot < kSlots; ++slot) put(nullptr, slot);
  }

 private:
  mutable std::mutex mutex_;
  std::array<std::shared_ptr<const T>, kSlots> slots_;
};

}  // namespace onset
