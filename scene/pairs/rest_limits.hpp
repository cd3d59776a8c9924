// What the shape at rest leaves pairs of their separation.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "base/aligned.hpp"
#include "base/buffer_pool.hpp"
#include "onset/options.hpp"
#include "scene/pair_sink.hpp"
#include "scene/primitive.hpp"

namespace onset {

// A pair and the most that it has to keep, model length.
struct RestLimit {
  IdPair pair;
  double most;
};

// The pairs that keep less than `reach`, by kind, in one norm.
class RestLimits {
 public:
  // reach: every pair with a smaller limit is in `sorted`, whose rows of each kind are sorted by (a, b).
  RestLimits(double reach, const std::array<std::vector<RestLimit>, kStepKinds.size()>& sorted)
      : reach_(reach), rows_{Rows(sorted[0]), Rows(sorted[1]), Rows(sorted[2])} {}

  double reach() const { return reach_; }
  // Returns a pair's limit; infinite where it is none below `reach`.
  double of(PairKind kind, IdPair pair) const {
    const Rows& rows = rows_[std::size_t(kind)];
    const std::size_t a = std::size_t(pair.a);
    if (a + 1 >= rows.first.size()) return std::numeric_limits<double>::infinity();
    const auto begin = rows.other.begin() + std::ptrdiff_t(rows.first[a]),
               end = rows.other.begin() + std::ptrdiff_t(rows.first[a + 1]);
    const auto place = std::lower_bound(begin, end, pair.b);
    if (place == end || *place != pair.b) return std::numeric_limits<double>::infinity();
    return rows.most[std::size_t(place - rows.other.begin())];
  }
  // Returns how many limits are below a reach.
  std::size_t count_below(double reach) const {
    const auto below = [reach](double limit) { return limit < reach; };
    std::size_t n = 0;
    for (const Rows& rows : rows_) n += std::size_t(std::count_if(rows.most.begin(), rows.most.end(), below));
    return n;
  }

 private:
  // Row a is [first[a], first[a + 1]).
  struct Rows {
    std::vector<std::size_t> first;
    std::vector<int> other;
    std::vector<double> most;
    explicit Rows(const std::vector<RestLimit>& sorted) {
      first.assign(sorted.empty() ? 0 : std::size_t(sorted.back().pair.a) + 2, 0);
      other.reserve(sorted.size()), most.reserve(sorted.size());
      for (const RestLimit& limit : sorted) {
        ++first[std::size_t(limit.pair.a) + 1];
        other.push_back(limit.pair.b), most.push_back(limit.most);
      }
      for (std::size_t a = 1; a < first.size(); ++a) first[a] += first[a - 1];
    }
  };

  double reach_;
  std::array<Rows, kStepKinds.size()> rows_;
};

// The shape at rest, and what calls found there; `limits` has a slot for each norm.
struct RestShape {
  // x y z of each vertex.
  std::vector<double> x;
  double share = 0.5;
  mutable SharedCache<RestLimits, 2> limits;
};

}  // namespace onset
