// Sorting by a 64-bit key in a few passes over the items.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace onset {

// Ascending and stable. `key(item)`: std::uint64_t. Only digits in which keys differ cost a pass.
template <class T, class Key>
void radix_sort(std::vector<T>& items, Key&& key) {
  constexpr int kBits = 11;
  constexpr std::uint64_t kDigit = (1u << kBits) - 1;
  std::uint64_t any = 0, all = ~std::uint64_t(0);
  for (const T& x : items) any |= key(x), all &= key(x);
  std::vector<T> other(items.size());
  for (std::uint64_t left = items.empty() ? 0 : any ^ all; left != 0;) {
    const int shift = __builtin_ctzll(left);
    left &= shift + kBits < 64 ? ~std::uint64_t(0) << (shift + kBits) : 0;
    std::array<std::size_t, kDigit + 1> start{};
    for (const T& x : items) ++start[(key(x) >> shift) & kDigit];
    std::size_t sum = 0;
    for (std::size_t& n : start) {
      const std::size_t here = n;
      n = sum, sum += here;
    }
    for (const T& x : items) other[start[(key(x) >> shift) & kDigit]++] = x;
    items.swap(other);
  }
}

}  // namespace onset
