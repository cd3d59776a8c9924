// What many tasks find, collected in parts, and then put in order.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <utility>
#include <vector>

#include "base/parallel.hpp"
#include "base/radix_sort.hpp"
#include "base/stop.hpp"

namespace onset {

// Holds items of any type that copies like plain data. Nothing is moved twice to make room, so that no step
// takes long however many there are.
template <class T>
class Parts {
 public:
  Parts() = default;
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;

  // Tasks hand over what they have once it is so much.
  static constexpr std::size_t kPart = kItemsALook;

  // Takes the items; any thread may call it.
  void add(std::vector<T>& items) {
    if (items.empty()) return;
    const std::lock_guard<std::mutex> lock(mutex_);
    count_ += items.size();
    if (items.size() >= kPart / 2)
      full_.push_back(std::move(items));
    else if (open_.insert(open_.end(), items.begin(), items.end()); open_.size() >= kPart / 2)
      full_.push_back(std::move(open_)), open_.clear();
    items.clear();
  }
  std::size_t size() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return count_;
  }
  // All threads help: to give back a gigabyte takes a tenth of a second.
  void clear() {
    std::vector<std::vector<T>> all;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      all.swap(full_);
      open_ = {};
      count_ = 0;
    }
    parallel_ranges(all.size(), kPartsATask, [&](std::size_t first, std::size_t last) {
      for (; first < last; ++first) all[first] = {};
    });
  }

  // Appends all items to `out`, ascending by key(item), a std::uint64_t that no two share, and is empty then.
  // Returns false where it was stopped: the items are then lost, and `out` is as it was.
  template <class Key>
  bool sort_into(std::vector<T>& out, const Key& key, const Stop& stop) {
    const std::size_t before = out.size();
    close();
    const bool sorted = count_ <= kPart ? sort_few(out, key) : Sort<Key>{full_, key, stop}.into(out, count_);
    clear();
    if (!sorted) out.resize(before);
    return sorted;
  }

  // Copies the first `most` items, or all, to other parts.
  void copy_some(Parts& to, std::size_t most) {
    close();
    for (std::size_t i = 0; i < full_.size() && most > 0; ++i) {
      const std::size_t count = std::min(full_[i].size(), most);
      std::vector<T> items(full_[i].begin(), full_[i].begin() + std::ptrdiff_t(count));
      to.add(items);
      most -= count;
    }
  }

 private:
  void close() {
    if (!open_.empty()) full_.push_back(std::move(open_));
    open_ = {};
  }
  template <class Key>
  bool sort_few(std::vector<T>& out, const Key& key) {
    const std::size_t before = out.size();
    out.reserve(before + count_);
    for (const std::vector<T>& part : full_) out.insert(out.end(), part.begin(), part.end());
    sort_by(out.data() + before, out.data() + out.size(), key);
    return true;
  }

  // Sorts into buckets by the highest bits that differ, and then each bucket.
  template <class Key>
  struct Sort {
    static constexpr int kBits = 11;

    std::vector<std::vector<T>>& parts;
    const Key& key;
    const Stop& stop;
    int shift = 0;

    bool into(std::vector<T>& out, std::size_t count) {
      const std::size_t before = out.size();
      std::vector<std::atomic<std::size_t>> place(std::size_t(1) << kBits);
      if (!find_shift() || !count_buckets(place) || !grow(out, before + count)) return false;
      std::size_t sum = before;
      for (auto& n : place) sum += n.exchange(sum);
      return scatter(place, out.data()) && sort_buckets(place, before, out.data());
    }

    std::size_t bucket(const T& item) const {
      return std::size_t(key(item) >> shift) & ((std::size_t(1) << kBits) - 1);
    }
    // f(part) for all; says whether it was not stopped.
    template <class F>
    bool each_part(F&& f) const {
      parallel_ranges(parts.size(), 1, [&](std::size_t first, std::size_t last) {
        for (; first < last && !stop.requested(); ++first) f(parts[first]);
      });
      return !stop.requested();
    }

    bool find_shift() {
      std::atomic<std::uint64_t> any{0}, all{~std::uint64_t(0)};
      const bool whole = each_part([&](const std::vector<T>& part) {
        std::uint64_t some = 0, every = ~std::uint64_t(0);
        for (const T& item : part) some |= key(item), every &= key(item);
        any |= some, all &= every;
      });
      const std::uint64_t differ = any ^ all;
      if (differ != 0) shift = std::max(0, 64 - __builtin_clzll(differ) - kBits);
      return whole;
    }
    std::vector<std::size_t> counts(const std::vector<T>& part) const {
      std::vector<std::size_t> n(std::size_t(1) << kBits);
      for (const T& item : part) ++n[bucket(item)];
      return n;
    }
    bool count_buckets(std::vector<std::atomic<std::size_t>>& place) const {
      return each_part([&](const std::vector<T>& part) {
        const std::vector<std::size_t> n = counts(part);
        for (std::size_t b = 0; b < n.size(); ++b)
          if (n[b] > 0) place[b] += n[b];
      });
    }
    bool grow(std::vector<T>& out, std::size_t size) const {
      out.reserve(size);
      while (out.size() < size && !stop.requested()) out.resize(std::min(size, out.size() + kPart));
      return out.size() == size;
    }
    // Leaves in `place` where each bucket ends.
    bool scatter(std::vector<std::atomic<std::size_t>>& place, T* out) const {
      return each_part([&](std::vector<T>& part) {
        std::vector<std::size_t> to = counts(part);
        for (std::size_t b = 0; b < to.size(); ++b)
          if (to[b] > 0) to[b] = place[b].fetch_add(to[b]);
        for (const T& item : part) out[to[bucket(item)]++] = item;
        part = {};
      });
    }
    bool sort_buckets(const std::vector<std::atomic<std::size_t>>& end, std::size_t before, T* out) const {
      parallel_ranges(end.size(), 1, [&](std::size_t first, std::size_t last) {
        for (; first < last && !stop.requested(); ++first)
          sort_bucket(out + (first == 0 ? before : end[first - 1].load()), out + end[first].load());
      });
      return !stop.requested();
    }
    void sort_bucket(T* first, T* last) const {
      const std::size_t count = std::size_t(last - first);
      if (count <= kPart) return sort_by(first, last, key);
      const std::unique_ptr<T[]> scratch(new T[count]);
      radix_sort(first, scratch.get(), count, key, stop);
    }
  };

  static constexpr std::size_t kPartsATask = 64;

  mutable std::mutex mutex_;
  std::vector<std::vector<T>> full_;
  std::vector<T> open_;
  std::size_t count_ = 0;
};

}  // namespace onset
