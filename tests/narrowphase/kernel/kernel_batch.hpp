// Queries as the kernels take them: positions of many pairs of one kind, four vertices each.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "narrowphase/kernel/float_positions.hpp"
#include "narrowphase/kernel/kernel.hpp"
#include "tests/queries/query.hpp"

namespace onset::tests {

class KernelBatch {
 public:
  explicit KernelBatch(PairKind kind) : kind_(kind) {}

  void add(const scenes::Query& query, double separation) {
    set_scale(query);
    const int first = int(ids_.size()) * 4;
    for (int i = 0; i < 4; ++i)
      for (const Point& p : {query.t0[i], query.t1[i]}) {
        x_.insert(x_.end(), p.begin(), p.end());
        x_.push_back(0);
      }
    ids_.push_back({first, first + 1, first + 2, first + 3});
    separation_.push_back(separation);
  }

  // From now on pairs() has rounded positions, too; after the last add().
  void round() {
    Motion motion;
    motion.num_vertices = 4 * count();
    motion.x = AlignedArray<double>(x_.size());
    std::copy(x_.begin(), x_.end(), motion.x.data());
    const AlignedArray<float> rows = round_positions(motion, scale_);
    rounded_.assign(rows.data(), rows.data() + rows.size());
  }

  PairKind kind() const { return kind_; }
  int count() const { return int(ids_.size()); }
  double separation(int row) const { return separation_[std::size_t(row)]; }

  // Of all pairs; views this object.
  KernelPairs pairs(double tolerance, bool maximum_norm = false, long long max_checks = 10000) const {
    KernelPairs p{};
    p.sharpest = 2;
    p.x = x_.data();
    p.rounded = rounded_.empty() ? nullptr : rounded_.data();
    p.vertices = reinterpret_cast<const int(*)[4]>(ids_.data());
    p.separation = separation_.data();
    p.count = count();
    p.scale = scale_;
    p.tolerance = p.reach = tolerance;
    p.t_max = p.cull_t_max = 1;
    p.maximum_norm = maximum_norm;
    p.max_checks = max_checks;
    return p;
  }

 private:
  // Brings the largest difference of coordinates near 1, as the pipeline does for a scene.
  void set_scale(const scenes::Query& query) {
    for (const auto* x : {&query.t0, &query.t1})
      for (const Point& p : *x)
        for (const Point& q : *x)
          for (int a = 0; a < 3; ++a)
            if (const double d = std::fabs(p[a] - q[a]); d > largest_ && d < INFINITY) largest_ = d;
    if (largest_ > 0) scale_ = std::ldexp(1.0, std::min(1000, -std::ilogb(largest_)));
  }

  PairKind kind_;
  double largest_ = 0, scale_ = 1;
  std::vector<double> x_;
  std::vector<float> rounded_;
  std::vector<std::array<int, 4>> ids_;
  std::vector<double> separation_;
};

}  // namespace onset::tests
