#include "files/scene/places.hpp"

#include <algorithm>
#include <numeric>

namespace app {
namespace {

template <class Before>
std::vector<Eigen::Index> first_of_equals(Eigen::Index rows, Before&& before) {
  std::vector<Eigen::Index> order(std::size_t(rows), 0), first(order);
  std::iota(order.begin(), order.end(), Eigen::Index(0));
  std::stable_sort(order.begin(), order.end(), before);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && !before(order[i - 1], order[i]);
    first[std::size_t(order[i])] = same ? first[std::size_t(order[i - 1])] : order[i];
  }
  return first;
}

// -1, 0 or 1.
int compare(const Points& x, Eigen::Index a, Eigen::Index b) {
  for (int c = 0; c < 3; ++c)
    if (x(a, c) != x(b, c)) return x(a, c) < x(b, c) ? -1 : 1;
  return 0;
}

}  // namespace

std::vector<Eigen::Index> first_at_place(const Points& x) {
  return first_of_equals(x.rows(), [&](Eigen::Index a, Eigen::Index b) { return compare(x, a, b) < 0; });
}

std::vector<std::array<int, 2>> copies_together(const Points& x_t0, const Points& x_t1) {
  const auto before = [&](Eigen::Index a, Eigen::Index b) {
    const int order = compare(x_t0, a, b);
    return order < 0 || (order == 0 && compare(x_t1, a, b) < 0);
  };
  const std::vector<Eigen::Index> first = first_of_equals(x_t0.rows(), before);
  std::vector<std::array<int, 2>> copies;
  for (std::size_t v = 0; v < first.size(); ++v)
    if (first[v] != Eigen::Index(v)) copies.push_back({int(first[v]), int(v)});
  std::sort(copies.begin(), copies.end());
  return copies;
}

}  // namespace app
