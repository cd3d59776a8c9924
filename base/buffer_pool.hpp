// Containers for what one call leaves for the next: objects to take over, and objects to share.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>

#include "base/assert.hpp"

namespace onset {

// What both have in common: one object a slot, put there from any thread. T may be incomplete here.
template <class T, std::size_t kSlots>
class Slots {
 public:
  void put(std::shared_ptr<T> object, std::size_t slot = 0) {
    ONSET_ASSERT(slot < kSlots);
    const std::lock_guard<std::mutex> lock(mutex_);
    slots_[slot].swap(object);  // the old object is destroyed after the lock
  }
  void clear() {
    for (std::size_t slot = 0; slot < kSlots; ++slot) put(nullptr, slot);
  }

 protected:
  mutable std::mutex mutex_;
  std::array<std::shared_ptr<T>, kSlots> slots_;
};

// Holds at most one unused object a slot; whoever takes it has it alone.
template <class T, std::size_t kSlots>
class BufferPool : public Slots<T, kSlots> {
 public:
  std::shared_ptr<T> take(std::size_t slot) {
    ONSET_ASSERT(slot < kSlots);
    const std::lock_guard<std::mutex> lock(this->mutex_);
    return std::exchange(this->slots_[slot], nullptr);
  }
};

// Holds the latest immutable object a slot; whoever got an earlier one keeps it.
template <class T, std::size_t kSlots = 1>
class SharedCache : public Slots<const T, kSlots> {
 public:
  std::shared_ptr<const T> get(std::size_t slot = 0) const {
    ONSET_ASSERT(slot < kSlots);
    const std::lock_guard<std::mutex> lock(this->mutex_);
    return this->slots_[slot];
  }
};

}  // namespace onset
