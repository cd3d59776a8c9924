// What is kept from call to call about the static part of a mesh: shared by all threads that use the mesh.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <mutex>

namespace onset {

// Each slot holds the latest immutable object put there; who took an earlier one keeps it.
class StaticCache {
 public:
  using Slot = std::size_t;
  static constexpr Slot motion = 0;
  // Of a box test and an order of axes, which may change back and forth while widths are nearly equal.
  static Slot trees(bool swept, const std::array<int, 3>& axes) {
    return 1 + std::size_t(swept) * 9 + std::size_t(3 * axes[0] + axes[1]);
  }

  template <class T>
  std::shared_ptr<const T> get(Slot slot) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return std::static_pointer_cast<const T>(slots_[slot]);
  }
  void put(Slot slot, std::shared_ptr<const void> object) {
    const std::lock_guard<std::mutex> lock(mutex_);
    slots_[slot].swap(object);  // the old one goes after the lock
  }

  void clear() {
    for (Slot slot = 0; slot < slots_.size(); ++slot) put(slot, nullptr);
  }

 private:
  mutable std::mutex mutex_;
  std::array<std::shared_ptr<const void>, 19> slots_;
};

}  // namespace onset
