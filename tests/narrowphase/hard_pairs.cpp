#include "tests/narrowphase/hard_pairs.hpp"

#include <algorithm>
#include <cmath>

#include "tests/queries/random_query.hpp"

namespace onset::tests {

using scenes::Query;
using scenes::Random;

namespace {

PairPoints mapped(PairPoints x, const std::array<int, 3>& axes, const Point& signs, double scale,
                  const Point& offset) {
  for (Point& p : x) {
    Point r;
    for (std::size_t a = 0; a < 3; ++a) r[a] = scale * signs[a] * p[std::size_t(axes[a])] + offset[a];
    p = r;
  }
  return x;
}
double sign(Random& random) { return scenes::coin(random) ? 1 : -1; }

double tiny(Random& random) {
  switch (scenes::integer(random, 0, 4)) {
    case 0:
      return 0;
    case 1:
      return std::ldexp(1.0, -scenes::integer(random, 20, 70)) * sign(random);
    default:
      return scenes::power_of_ten(random, -17, -6) * sign(random);
  }
}

}  // namespace

PairPoints placed(PairPoints x, Random& random) {
  std::array<int, 3> axes{0, 1, 2};
  std::rotate(axes.begin(), axes.begin() + scenes::integer(random, 0, 2), axes.end());
  if (scenes::coin(random)) std::swap(axes[0], axes[1]);
  Point offset{0, 0, 0};
  if (scenes::integer(random, 0, 3) == 0) offset = scenes::point(random, scenes::power_of_ten(random, -2, 6));
  if (scenes::integer(random, 0, 3) == 0) {
    const scenes::Matrix m = scenes::rotation(random, scenes::uniform(random, 0, 6));
    for (Point& p : x) p = scenes::product(m, p);
  }
  const int exponents[] = {0, 0, 0, -1010, 950, scenes::integer(random, -1060, 950)};
  const double scale = std::ldexp(1.0, exponents[scenes::integer(random, 0, 5)]);
  x = mapped(x, axes, {sign(random), sign(random), sign(random)}, 1, offset);
  return mapped(x, {0, 1, 2}, {1, 1, 1}, scale, {0, 0, 0});
}

PairPoints tie(PairKind kind, Random& random) {
  const double height = scenes::power_of_ten(random, -12, 0);
  Point at{tiny(random), tiny(random), height};
  if (kind == PairKind::vertex_face) {
    if (scenes::coin(random)) at[0] += 0.5;  // above the middle of a side
    return {at, Point{0, 0, 0}, Point{1, tiny(random), tiny(random)},
            Point{scenes::uniform(random, -1, 1), -1, scenes::coin(random) ? tiny(random) : -1}};
  }
  // The end of one edge above the other edge, or above its end.
  const double to = scenes::coin(random) ? 0 : scenes::uniform(random, -1, 1);
  return {
      Point{scenes::coin(random) ? -1.0 : 0.0, 0, 0}, Point{1, tiny(random), tiny(random)}, at,
      Point{at[0] + to, at[1] + 1, height + (scenes::coin(random) ? tiny(random) : scenes::unit(random))}};
}

PairPoints needle(PairKind kind, Random& random) {
  const Point along = scenes::point(random);
  const double width = scenes::power_of_ten(random, -18, -1), s = scenes::uniform(random, -0.2, 1.2);
  const auto near = [&](double t, double off) {
    Point p = scenes::times(t, along);
    for (double& c : p) c += off * scenes::uniform(random, -1, 1);
    return p;
  };
  const double height = scenes::power_of_ten(random, -18, 0);
  if (kind == PairKind::vertex_face)
    return {near(s, height), Point{0, 0, 0}, near(1, 0), near(scenes::unit(random), width)};
  return {Point{0, 0, 0}, near(1, 0), near(s, height),
          near(s + scenes::uniform(random, -1, 1), height + width)};
}

PairPoints parallel(PairKind kind, Random& random) {
  const double angle = scenes::coin(random) ? 0 : scenes::power_of_ten(random, -17, -6);
  const double x = scenes::uniform(random, -1.5, 1.5),
               height = scenes::coin(random) ? 0 : scenes::power_of_ten(random, -15, 0);
  if (kind == PairKind::vertex_face)  // next to no area
    return {Point{x, height, tiny(random)}, Point{-1, 0, 0}, Point{1, 0, 0},
            Point{scenes::uniform(random, -2, 2), angle, tiny(random)}};
  const Point base{x, tiny(random), height};
  return {Point{-1, 0, 0}, Point{1, 0, 0}, base,
          scenes::plus(base, Point{sign(random), angle, tiny(random)})};
}

PairPoints degenerate(PairKind kind, Random& random) {
  PairPoints x{scenes::point(random), scenes::point(random), scenes::point(random), scenes::point(random)};
  const std::size_t side = std::size_t(scenes::first_body(kind));
  x[3] = scenes::integer(random, 0, 2) == 0 ? x[2] : scenes::times(scenes::integer(random, -1, 2), x[2]);
  if (scenes::coin(random)) x[1] = x[scenes::coin(random) ? 0 : 2];
  if (scenes::integer(random, 0, 3) == 0)
    x[0] = scenes::plus(x[side], Point{tiny(random), tiny(random), tiny(random)});
  if (scenes::integer(random, 0, 9) == 0) x = {x[0], x[0], x[0], x[0]};
  return x;
}

PairPoints lattice(PairKind kind, Random& random) {
  const Query q = scenes::grid_query(kind, random, 1 + int(scenes::coin(random)));
  return q.t0;
}

PairPoints near_touching(PairKind kind, Random& random) {
  Query query = scenes::random_query(kind, random);
  for (Point& p : query.t0)
    for (double& c : p) c = std::round(64 * c) / 64;
  const std::size_t first = std::size_t(scenes::first_body(kind));
  Point& moved = query.t0[0];
  if (scenes::coin(random))
    moved = query.t0[first];
  else
    moved = scenes::times(0.5, scenes::plus(query.t0[first], query.t0[first + 1]));
  moved[std::size_t(scenes::integer(random, 0, 2))] +=
      scenes::power_of_ten(random, scenes::coin(random) ? -300 : -20, 0);
  return query.t0;
}

}  // namespace onset::tests
