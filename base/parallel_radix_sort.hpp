// Sorting by a 64-bit key with all threads of the arena.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/parallel.hpp"
#include "base/radix_sort.hpp"
#include "base/stop.hpp"

namespace onset {

inline constexpr std::size_t kFewToSort = 2000;  // so few are sorted faster by comparing

// Deals items out into buckets by their keys, whose ranges follow on one another, and sorts each bucket.
template <class T, class Key>
class BucketSort {
 public:
  BucketSort(T* items, T* scratch, std::size_t count, const Key& key, std::size_t pieces, const Stop& stop)
      : items_(items), scratch_(scratch), count_(count), pieces_(pieces), key_(key), stop_(stop) {}

  bool run() {
    choose_borders();
    const std::size_t buckets = borders_.size() + 1;
    std::vector<std::vector<std::size_t>> place(pieces_);  // where a piece puts the next of a bucket
    if (!each(pieces_, [&](std::size_t piece) {
          std::vector<std::size_t> n(buckets);
          const bool all = each_of(piece, [&](std::size_t i) { ++n[bucket(i)]; });
          place[piece] = std::move(n);
          return all;
        }))
      return false;
    std::vector<std::size_t> first{0};
    for (std::size_t b = 0, sum = 0; b < buckets; first.push_back(sum), ++b)
      for (std::vector<std::size_t>& of_piece : place) {
        const std::size_t here = of_piece[b];
        of_piece[b] = sum, sum += here;
      }
    return each(pieces_,
                [&](std::size_t piece) {
                  std::vector<std::size_t> to = std::move(place[piece]);
                  return each_of(piece, [&](std::size_t i) { scratch_[to[bucket(i)]++] = items_[i]; });
                }) &&
           each(buckets, [&](std::size_t b) { return sort(first[b], first[b + 1]); });
  }

 private:
  // Four buckets a piece, so that threads that are done early help on.
  void choose_borders() {
    constexpr std::size_t kBucketsAPiece = 4, kSamplesABucket = 16;
    const std::size_t buckets = kBucketsAPiece * pieces_, samples = buckets * kSamplesABucket;
    std::vector<std::uint64_t> some(samples);
    for (std::size_t i = 0; i < samples; ++i) some[i] = key_(items_[count_ / samples * i]);
    std::sort(some.begin(), some.end());
    for (std::size_t b = 1; b < buckets; ++b) borders_.push_back(some[b * kSamplesABucket]);
  }
  std::size_t bucket(std::size_t i) const {
    return std::size_t(std::upper_bound(borders_.begin(), borders_.end(), key_(items_[i])) -
                       borders_.begin());
  }

  bool sort(std::size_t first, std::size_t last) {
    T* const from = scratch_ + first;
    if (last - first < kFewToSort)
      sort_by(from, from + (last - first), key_);
    else if (!radix_sort(from, items_ + first, last - first, key_, stop_))
      return false;
    return each_unless(stop_, first, last, [&](std::size_t i) { items_[i] = scratch_[i]; });
  }

  // f(i) for i < count in parallel; false where one of them returned that.
  template <class F>
  static bool each(std::size_t count, const F& f) {
    std::atomic<bool> all{true};
    parallel_ranges(count, 1, [&](std::size_t i, std::size_t end) {
      for (; i < end; ++i)
        if (!f(i)) all = false;
    });
    return all;
  }
  template <class F>
  bool each_of(std::size_t piece, F&& f) const {
    return each_unless(stop_, count_ / pieces_ * piece,
                       piece + 1 == pieces_ ? count_ : count_ / pieces_ * (piece + 1), f);
  }

  T *items_, *scratch_;
  std::size_t count_, pieces_;
  const Key& key_;
  const Stop& stop_;
  std::vector<std::uint64_t> borders_;
};

// As radix_sort, by all threads of the arena where there is enough for them, of items of which no two share a
// key.
template <class T, class Key>
bool parallel_radix_sort(T* items, T* scratch, std::size_t count, const Key& key, const Stop& stop = {}) {
  if (count < kFewToSort) return sort_by(items, items + count, key), true;
  const std::size_t pieces = sort_pieces(count);
  if (pieces == 1) return radix_sort(items, scratch, count, key, stop);
  return BucketSort<T, Key>(items, scratch, count, key, pieces, stop).run();
}

}  // namespace onset
