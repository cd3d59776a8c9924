#include "tests/steps/support/ties_and_needles.hpp"

#include "tests/queries/random_query.hpp"

namespace onset::tests {

using scenes::Query;
using scenes::Random;

static double sign(Random& random) { return scenes::coin(random) ? 1 : -1; }

// A little, or exactly, off zero.
static double off(Random& random) {
  return scenes::integer(random, 0, 5) == 0 ? 0 : sign(random) * scenes::power_of_ten(random, -16, -6);
}

// A vertex over corner 1, height h along z; the sides leave the corner nearly at a right angle to z, or below
// it.
static std::array<Point, 4> over_a_corner(Random& random, double h) {
  const double turn = scenes::uniform(random, 0, 6.28), angle = scenes::uniform(random, 0.1, 3);
  const double thin = scenes::integer(random, 0, 2) ? 1 : scenes::power_of_ten(random, -12, -2);
  const double down = scenes::coin(random) ? off(random) : scenes::uniform(random, -1, 0);
  const double c = std::cos(turn), s = std::sin(turn), opened = turn + angle * thin;
  const Point side{c, s, off(random)}, other{std::cos(opened), std::sin(opened), down};
  const Point along = scenes::coin(random) ? Point{} : scenes::times(off(random), side);
  return {scenes::plus({0, 0, h}, along), {}, side, scenes::times(scenes::uniform(random, 0.2, 2), other)};
}

// A vertex over the inside or a side of a needle.
static std::array<Point, 4> over_a_needle(Random& random, double h) {
  const double thin = scenes::power_of_ten(random, -12, -2), u = scenes::unit(random), v = off(random) / thin;
  const Point tip{scenes::uniform(random, 0.1, 0.9), thin, off(random)};
  const Point p = scenes::plus({u, scenes::coin(random) ? thin * v : thin * scenes::unit(random), h}, {});
  return {p, {}, {1, 0, 0}, tip};
}

// Edges at height h over one another: nearly parallel, with ends over ends, or an end over the other's
// inside.
static std::array<Point, 4> edges(Random& random, double h) {
  const double turn = scenes::coin(random) ? off(random) * scenes::power_of_ten(random, 0, 5)
                                           : scenes::uniform(random, -1, 1);
  const double at = scenes::coin(random) ? scenes::integer(random, 0, 1) + off(random) : scenes::unit(random);
  const double from = scenes::coin(random) ? off(random) : scenes::uniform(random, -1, 1);
  const double length = scenes::integer(random, 0, 2) ? 1 : scenes::power_of_ten(random, -12, -1);
  const Point direction{std::cos(turn), std::sin(turn), off(random)};
  const Point b0 = scenes::plus({at, 0, -h}, scenes::times(from * length, direction));
  return {Point{}, {1, off(random), off(random)}, b0, scenes::plus(b0, scenes::times(length, direction))};
}

Query tie_or_needle(PairKind kind, Random& random) {
  const double h = scenes::power_of_ten(random, -12, 0);
  std::array<Point, 4> x = kind == PairKind::edge_edge     ? edges(random, h)
                           : scenes::integer(random, 0, 2) ? over_a_corner(random, h)
                                                           : over_a_needle(random, h);
  Query query{kind, x, x};
  const double far = h * scenes::power_of_ten(random, -3, 2), own = scenes::integer(random, 0, 2) ? 0 : far;
  const double press = scenes::integer(random, -1, 1), slide = scenes::coin(random) ? 0 : 1;
  const Point step = scenes::plus({0, 0, -press * far}, scenes::point(random, slide * far));
  for (int i = 0; i < 4; ++i) {
    Point& p = query.t1[std::size_t(i)];
    if (i < scenes::first_body(kind)) p = scenes::plus(p, step);
    p = scenes::plus(p, scenes::point(random, 0.3 * own));
  }
  if (scenes::coin(random))
    query = transformed(query, scenes::rotation(random, scenes::uniform(random, 0, 3)));
  else
    query = transformed(query, scenes::signed_permutation(random));
  if (scenes::coin(random)) query = moved(query, scenes::point(random, scenes::power_of_ten(random, -3, 2)));
  return scaled(query, scenes::power_of_ten(random, -4, 4));
}

double separation_near(double distance, Random& random) {
  return distance * (1 + sign(random) * scenes::power_of_ten(random, -16, -1));
}

}  // namespace onset::tests
