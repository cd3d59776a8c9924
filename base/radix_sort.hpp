// Sorting by a 64-bit key in a few passes over the items.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "base/stop.hpp"

namespace onset {

// Sorts by key(item) by comparing.
template <class T, class Key>
void sort_by(T* first, T* last, const Key& key) {
  std::sort(first, last, [&](const T& x, const T& y) { return key(x) < key(y); });
}

// Sorts by key(item), a std::uint64_t, ascending and stable. Only digits in which keys differ cost a pass.
// `scratch` is room for as many items, which is overwritten. Returns false where it was stopped: the items
// are then lost.
template <class T, class Key>
bool radix_sort(T* items, T* scratch, std::size_t count, Key&& key, const Stop& stop = {}) {
  constexpr int kBits = 11;
  constexpr std::uint64_t kDigit = (1u << kBits) - 1;
  std::uint64_t any = 0, all = ~std::uint64_t(0);
  if (!each_unless(stop, 0, count, [&](std::size_t i) { any |= key(items[i]), all &= key(items[i]); }))
    return false;
  T *from = items, *to = scratch;
  for (std::uint64_t left = count == 0 ? 0 : any ^ all; left != 0;) {
    const int shift = __builtin_ctzll(left);
    left &= shift + kBits < 64 ? ~std::uint64_t(0) << (shift + kBits) : 0;
    const auto digit = [&](std::size_t i) { return std::size_t((key(from[i]) >> shift) & kDigit); };
    std::array<std::size_t, kDigit + 1> start{};
    if (!each_unless(stop, 0, count, [&](std::size_t i) { ++start[digit(i)]; })) return false;
    std::size_t sum = 0;
    for (std::size_t& n : start) {
      const std::size_t here = n;
      n = sum, sum += here;
    }
    if (!each_unless(stop, 0, count, [&](std::size_t i) { to[start[digit(i)]++] = from[i]; })) return false;
    std::swap(from, to);
  }
  return from == items || each_unless(stop, 0, count, [&](std::size_t i) { items[i] = std::move(from[i]); });
}

template <class T, class Key>
bool radix_sort(std::vector<T>& items, Key&& key, const Stop& stop = {}) {
  const std::unique_ptr<T[]> scratch(new T[items.size()]);  // written before it is read
  return radix_sort(items.data(), scratch.get(), items.size(), key, stop);
}

}  // namespace onset
