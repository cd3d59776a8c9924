#include "tests/oracle/walk.hpp"

#include <algorithm>
#include <cmath>

namespace onset::oracle {

// f(difference at t = 0, difference at t = 1) for all pairs of corners, one from each primitive.
template <class F>
static void for_corners(const scenes::Query& query, F&& f) {
  const int first = scenes::first_body(query.kind);
  for (int i = 0; i < first; ++i)
    for (int j = first; j < 4; ++j)
      f(scenes::minus(query.t0[i], query.t0[j]), scenes::minus(query.t1[i], query.t1[j]));
}

double extent(const scenes::Query& query) {
  double largest = 0;
  for_corners(query, [&](const Point& at_t0, const Point& at_t1) {
    for (int k = 0; k < 3; ++k) largest = std::max({largest, std::abs(at_t0[k]), std::abs(at_t1[k])});
  });
  return largest * (1 + 0x1p-50);
}

double relative_speed(const scenes::Query& query) {
  double fastest = 0;
  for_corners(query, [&](const Point& at_t0, const Point& at_t1) {
    double sum =
        0;  // |x|_1 >= |x|_2; 2^-50 of the largest operand covers the three roundings of each component
    for (int k = 0; k < 3; ++k)
      sum += std::abs(at_t1[k] - at_t0[k]) + 0x1p-50 * std::max(std::abs(at_t0[k]), std::abs(at_t1[k]));
    fastest = std::max(fastest, sum * (1 + 0x1p-50) + 0x1p-1070);
  });
  return fastest;
}

Walk walk(const scenes::Query& query, double gap, double until, int steps, Norm norm) {
  const double v = relative_speed(query);  // in the maximum norm it is no greater
  Walk w;
  while (steps-- > 0) {
    const double spare = distance(query, w.apart_until, norm).lo - gap;
    if (!(spare > 0)) return w;
    const double next = w.apart_until + spare / v * (1 - 0x1p-40);
    if (next > 1) return {1, true};
    if (!(std::nextafter(next, 0) > w.apart_until) || w.apart_until >= until) return w;
    w.apart_until = std::nextafter(next, 0);
  }
  return w;
}

}  // namespace onset::oracle
