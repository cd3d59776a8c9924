#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

#include "base/parallel.hpp"
#include "onset/check.hpp"
#include "src/start/places.hpp"

namespace onset {

namespace {

// Integers in the order of the finite numbers, -0 being 0: they compare alike on threads that flush subnormal
// numbers.
std::int64_t ordered(double x) {
  std::int64_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  return bits < 0 ? std::numeric_limits<std::int64_t>::min() - bits : bits;
}

}  // namespace

std::vector<std::vector<int>> shared_places(const Positions& x) {
  std::vector<int> order(std::size_t(x.rows()));
  std::iota(order.begin(), order.end(), 0);
  const auto compare = [&](int v, int w) {
    for (int a = 0; a < 3; ++a)
      if (const std::int64_t p = ordered(x(v, a)), q = ordered(x(w, a)); p != q) return p < q ? -1 : 1;
    return 0;
  };
  parallel_sort(order.begin(), order.end(), [&](int v, int w) {
    const int c = compare(v, w);
    return c != 0 ? c < 0 : v < w;
  });
  std::vector<std::vector<int>> places;
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (compare(order[i - 1], order[i]) != 0) continue;
    if (i == 1 || compare(order[i - 2], order[i - 1]) != 0) places.push_back({order[i - 1]});
    places.back().push_back(order[i]);
  }
  std::sort(places.begin(), places.end());
  return places;
}

std::vector<std::array<int, 2>> duplicate_vertices(const Positions& x) {
  const FloatEnvironment environment;
  if (x.cols() != 3) throw std::invalid_argument("x has " + std::to_string(x.cols()) + " columns, not 3");
  for (std::ptrdiff_t v = 0; v < x.rows(); ++v)
    for (int a = 0; a < 3; ++a)
      if (!std::isfinite(x(v, a)))
        throw std::invalid_argument("x row " + std::to_string(v) + ": " + std::to_string(x(v, a)) +
                                    " is not finite");
  std::vector<std::array<int, 2>> pairs;
  for (const std::vector<int>& here : shared_places(x))
    for (std::size_t j = 1; j < here.size(); ++j)
      for (std::size_t i = 0; i < j; ++i) pairs.push_back({here[i], here[j]});
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace onset
