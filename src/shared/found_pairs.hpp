// The pairs that a traversal found: how they are ordered, and the earliest of many.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "base/assert.hpp"
#include "base/parallel.hpp"
#include "base/parallel_radix_sort.hpp"
#include "narrowphase/narrow_phase.hpp"
#include "onset/result.hpp"
#include "src/shared/budget.hpp"
#include "src/shared/visit_pairs.hpp"

namespace onset {

// A pair that is not free, and what was found of it.
struct FoundPair {
  PairKind kind;
  PairResult result;
};

// One number orders pairs as (kind, a, b) does, since ids are not negative and kinds less than four.
inline std::uint64_t order_of(PairKind kind, IdPair pair) {
  return std::uint64_t(kind) << 62 | std::uint64_t(pair.a) << 31 | std::uint64_t(pair.b);
}
inline PairKind kind_of_order(std::uint64_t order) { return PairKind(order >> 62); }

// Orders by (kind, a, b), as an active set is.
inline bool before(const FoundPair& x, const FoundPair& y) {
  return order_of(x.kind, x.result.pair) < order_of(y.kind, y.result.pair);
}
// The count of one kind.
inline std::int64_t& count_of(PairKind kind, PairCounts& counts) {
  switch (kind) {
    case PairKind::vertex_face:
      return counts.vertex_face;
    case PairKind::edge_edge:
      return counts.edge_edge;
    case PairKind::vertex_edge:
      return counts.vertex_edge;
    default:
      return counts.vertex_plane;
  }
}
// Orders by (toi, kind, a, b).
inline bool earlier(const FoundPair& x, const FoundPair& y) {
  return x.result.toi != y.result.toi ? x.result.toi < y.result.toi : before(x, y);
}

// Holds what tasks found.
class FoundPairs {
 public:
  // Of more than `most`, only the earliest are wanted.
  explicit FoundPairs(std::size_t most) : most_(most) {}

  void add(PairKind kind, std::vector<PairResult>&& results) {
    if (results.empty()) return;
    held_ += results.size();
    parts_.push_back({kind, std::move(results)});
  }
  void add(FoundPairs&& others) {
    held_ += others.held_;
    for (Part& part : others.parts_) parts_.push_back(std::move(part));
  }

  // Says whether so many are held that the latest should go.
  bool too_many() const {
    return most_ < std::numeric_limits<std::size_t>::max() && held_ > most_ + most_ / 2 + kSlack;
  }

  // Drops all but the earliest `most`, and returns the latest time of these, where there are so many. Not all
  // are dropped where it is stopped.
  std::optional<double> keep_earliest(const Stop& stop) {
    if (held_ < most_ || most_ == 0) return std::nullopt;
    const std::optional<Time> last = latest_kept(stop);
    if (!last) return std::nullopt;
    held_ = 0;
    for (Part& part : parts_) {
      const auto is_later = [&](const PairResult& r) { return *last < time_of(part.kind, r); };
      if (!stop.requested())
        part.results.erase(std::remove_if(part.results.begin(), part.results.end(), is_later),
                           part.results.end());
      held_ += part.results.size();
    }
    return last->toi;
  }

  // Returns the earliest `most`, sorted by `before`; where time or the caller ends that, some of them.
  std::vector<FoundPair> take(Budget& budget) {
    const Stop stop = budget.interruption();
    std::vector<FoundPair> all;
    if (!stop.requested()) {
      keep_earliest(stop);
      if (sort_into(all, stop)) return all;
    }
    all = {};
    keep_some();
    sort_into(all, {});
    return all;
  }

 private:
  // What one task found.
  struct Part {
    PairKind kind;
    std::vector<PairResult> results;
  };
  struct Time {
    double toi;
    std::uint64_t order;
    bool operator<(const Time& o) const { return toi != o.toi ? toi < o.toi : order < o.order; }
  };
  // So many beyond half as many again as are wanted are held before the latest are dropped.
  static constexpr std::size_t kSlack = 1024;
  static constexpr std::size_t kPartsATask = 4;

  static Time time_of(PairKind kind, const PairResult& r) { return {r.toi, order_of(kind, r.pair)}; }

  // Returns the time of the last one to keep: halves the times that may be it, again and again.
  std::optional<Time> latest_kept(const Stop& stop) const {
    std::vector<Time> times, below, rest;
    times.reserve(held_);
    for (const Part& part : parts_) {
      if (stop.requested()) return std::nullopt;
      for (const PairResult& r : part.results) times.push_back(time_of(part.kind, r));
    }
    std::size_t place = most_ - 1;
    while (times.size() > kItemsALook) {
      const Time pivot = median_of_some(times);
      below.clear(), rest.clear();
      if (!each_unless(stop, 0, times.size(),
                       [&](std::size_t i) { (times[i] < pivot ? below : rest).push_back(times[i]); }))
        return std::nullopt;
      const bool is_below = place < below.size();
      if (!is_below) place -= below.size();
      times.swap(is_below ? below : rest);
    }
    std::nth_element(times.begin(), times.begin() + std::ptrdiff_t(place), times.end());
    return times[place];
  }
  // No two are the same, so that some are below it.
  static Time median_of_some(const std::vector<Time>& times) {
    constexpr std::size_t kSome = 63;
    Time some[kSome];
    for (std::size_t i = 0; i < kSome; ++i) some[i] = times[times.size() / kSome * i];
    std::nth_element(some, some + kSome / 2, some + kSome);
    return some[kSome / 2];
  }

  void keep_some() {
    std::size_t left = std::min(kRowsCutOff, most_), parts = 0;
    for (; parts < parts_.size() && left > 0; ++parts) {
      std::vector<PairResult>& results = parts_[parts].results;
      if (results.size() > left) results.erase(results.begin() + std::ptrdiff_t(left), results.end());
      left -= results.size();
    }
    parallel_ranges(parts_.size() - parts, 64, [&](std::size_t first, std::size_t last) {
      for (; first < last; ++first) parts_[parts + first].results = {};  // a tenth of a second a gigabyte
    });
    parts_.resize(parts);
    held_ = std::min(kRowsCutOff, most_) - left;
  }

  struct Place {
    std::uint64_t order;
    const PairResult* result;
  };

  // Sorts sixteen bytes a pair and moves each result once. Returns false where it was stopped.
  bool sort_into(std::vector<FoundPair>& out, const Stop& stop) const {
    const std::unique_ptr<Place[]> places(new Place[held_]);
    std::unique_ptr<Place[]> scratch(new Place[held_]);
    if (!list_places(places.get(), stop)) return false;
    const auto order = [](const Place& p) { return p.order; };
    if (!parallel_radix_sort(places.get(), scratch.get(), held_, order, stop)) return false;
    scratch.reset();
    out.reserve(held_);
    const auto found = [&](std::size_t i) {
      return FoundPair{kind_of_order(places[i].order), *places[i].result};
    };
    if (sort_pieces(held_) == 1)
      return each_unless(stop, 0, held_, [&](std::size_t i) { out.push_back(found(i)); });
    for (; out.size() < held_; out.resize(std::min(out.size() + kItemsALook, held_)))
      if (stop.requested()) return false;
    std::atomic<bool> all{true};
    parallel_ranges(held_, kItemsALook, [&](std::size_t first, std::size_t last) {
      if (!each_unless(stop, first, last, [&](std::size_t i) { out[i] = found(i); })) all = false;
    });
    return all;
  }

  bool list_places(Place* places, const Stop& stop) const {
    std::vector<std::size_t> start{0};
    start.reserve(parts_.size() + 1);
    for (const Part& part : parts_) start.push_back(start.back() + part.results.size());
    ONSET_ASSERT(start.back() == held_);
    std::atomic<bool> all{true};
    parallel_ranges(parts_.size(), kPartsATask, [&](std::size_t first, std::size_t last) {
      for (; first < last; ++first) {
        if (stop.requested()) return void(all = false);
        Place* to = places + start[first];
        for (const PairResult& r : parts_[first].results) *to++ = {order_of(parts_[first].kind, r.pair), &r};
      }
    });
    return all;
  }

  std::size_t most_, held_ = 0;
  std::vector<Part> parts_;
};

}  // namespace onset
