// The question, asked in the middle of long work, whether anybody still waits for it.
#pragma once

#include <cstddef>

namespace onset {

// It is a plain callback, so that a kernel compiled for another instruction set can ask it.
struct Stop {
  void* context = nullptr;
  bool (*asked)(void* context) = nullptr;  // null: the work is always wanted

  // Once it says so, it says so for good.
  bool requested() const { return asked != nullptr && asked(context); }
};

// Simple loops ask once in so many items: well below a millisecond.
inline constexpr std::size_t kItemsALook = 1 << 14;

// f(i) for i in [first, last), asking every kItemsALook. Returns false where it was stopped in between.
template <class F>
bool each_unless(const Stop& stop, std::size_t first, std::size_t last, F&& f) {
  while (first < last) {
    if (stop.requested()) return false;
    for (const std::size_t end = last - first < kItemsALook ? last : first + kItemsALook; first < end;
         ++first)
      f(first);
  }
  return true;
}

}  // namespace onset
