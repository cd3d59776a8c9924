// What must not change an answer, as operations on a query.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "tests/queries/query.hpp"

namespace onset::tests {

// An order of the three axes, then a sign for each.
struct SignedPermutation {
  std::array<int, 3> axes;
  std::array<int, 3> signs;
  Point operator()(const Point& p) const {
    return {signs[0] * p[axes[0]], signs[1] * p[axes[1]], signs[2] * p[axes[2]]};
  }
};

// All 48, the identity first.
inline std::vector<SignedPermutation> signed_permutations() {
  std::vector<SignedPermutation> all;
  for (const std::array<int, 3>& axes :
       {std::array<int, 3>{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}})
    for (int bits = 0; bits < 8; ++bits)
      all.push_back({axes, {bits & 1 ? -1 : 1, bits & 2 ? -1 : 1, bits & 4 ? -1 : 1}});
  return all;
}

// Whether x 2^exponent is a double.
inline bool scales_exactly(double x, int exponent) {
  const double y = std::ldexp(x, exponent);
  return std::isfinite(y) && std::ldexp(y, -exponent) == x;
}
inline bool scales_exactly(const scenes::Query& query, int exponent) {
  for (const auto* points : {&query.t0, &query.t1})
    for (const Point& p : *points)
      for (double x : p)
        if (!scales_exactly(x, exponent)) return false;
  return true;
}

// The same pair said in another way: the face's vertices in another order, the edges' ends, the edges
// themselves.
inline std::vector<scenes::Query> relabelled(const scenes::Query& query) {
  using Order = std::array<int, 4>;
  const std::vector<Order> orders =
      query.kind == PairKind::vertex_face
          ? std::vector<Order>{{0, 2, 3, 1}, {0, 3, 1, 2}, {0, 1, 3, 2}, {0, 3, 2, 1}, {0, 2, 1, 3}}
          : std::vector<Order>{{2, 3, 0, 1}, {1, 0, 2, 3}, {0, 1, 3, 2}, {1, 0, 3, 2}, {3, 2, 1, 0}};
  std::vector<scenes::Query> all;
  for (const Order& order : orders) {
    scenes::Query q = query;
    for (int i = 0; i < 4; ++i) q.t0[i] = query.t0[order[i]], q.t1[i] = query.t1[order[i]];
    all.push_back(q);
  }
  return all;
}

}  // namespace onset::tests
