// Sorting by a 64-bit key in a few passes over the items.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace onset {

// Sorts by key(item), a std::uint64_t, ascending and stable. Only digits in which keys differ cost a pass.
// `scratch` is room for as many items, which is overwritten.
template <class T, class Key>
void radix_sort(T* items, T* scratch, std::size_t count, Key&& key) {
  constexpr int kBits = 11;
  constexpr std::uint64_t kDigit = (1u << kBits) - 1;
  std::uint64_t any = 0, all = ~std::uint64_t(0);
  for (std::size_t i = 0; i < count; ++i) any |= key(items[i]), all &= key(items[i]);
  T *from = items, *to = scratch;
  for (std::uint64_t left = count == 0 ? 0 : any ^ all; left != 0;) {
    const int shift = __builtin_ctzll(left);
    left &= shift + kBits < 64 ? ~std::uint64_t(0) << (shift + kBits) : 0;
    std::array<std::size_t, kDigit + 1> start{};
    for (std::size_t i = 0; i < count; ++i) ++start[(key(from[i]) >> shift) & kDigit];
    std::size_t sum = 0;
    for (std::size_t& n : start) {
      const std::size_t here = n;
      n = sum, sum += here;
    }
    for (std::size_t i = 0; i < count; ++i) to[start[(key(from[i]) >> shift) & kDigit]++] = from[i];
    std::swap(from, to);
  }
  if (from != items) std::copy(from, from + count, items);
}

template <class T, class Key>
void radix_sort(std::vector<T>& items, Key&& key) {
  std::vector<T> scratch(items.size());
  radix_sort(items.data(), scratch.data(), items.size(), key);
}

}  // namespace onset
