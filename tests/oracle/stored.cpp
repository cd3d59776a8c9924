#include "tests/oracle/stored.hpp"

#include <algorithm>

#include "tests/oracle/arithmetic/exact_points.hpp"
#include "tests/oracle/contact.hpp"
#include "tests/oracle/oracle.hpp"
#include "tests/oracle/quick.hpp"

namespace onset::oracle {

std::array<Point, 4> stored(Rounding how, const scenes::Query& motion, double s) {
  std::array<Point, 4> x;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 3; ++k) x[i][k] = stored(how, motion.t0[i][k], motion.t1[i][k], s);
  return x;
}

int compare_distance_at_rest(PairKind kind, const std::array<Point, 4>& x, double d, Norm norm) {
  return compare_distance({kind, x, x}, 0, d, norm);
}

// For the quick answer: how far storing can move a coordinate of size M or less. The rounding of x1 - x0, of
// the product and of the sum are u 2M, u 2M and u M, of the weights and the weighted sum no more; 2^-50 M is
// 8u M.
static double most_moved(const scenes::Query& motion) {
  double largest = 0x1p-1000;
  for (const auto* points : {&motion.t0, &motion.t1})
    for (const Point& p : *points)
      for (double x : p) largest = std::max(largest, std::fabs(x));
  return 0x1p-50 * largest;
}

const char* broken_on_the_way(const scenes::Query& motion, double s, const std::array<Point, 4>& stored) {
  if (surely_apart(motion, s, most_moved(motion))) return "";
  const Rational scale = unit_scale(motion), part(s);
  const ExactPoints from = exact(motion.t0, scale), to = exact(motion.t1, scale);
  ExactPoints end;
  for (std::size_t i = 0; i < 4; ++i) end[i] = from[i] - scaled<Rational>(part, from[i] - to[i]);
  if (s > 0 && FirstContact<Rational>(motion.kind, from, end).time()) return "touches on the exact way";
  if (compare_distance_at_rest(motion.kind, stored, 0) == 0) return "touches as stored";
  if (FirstContact<Rational>(motion.kind, end, exact(stored, scale)).time())
    return "is stored on the other side";
  return "";
}

}  // namespace onset::oracle
