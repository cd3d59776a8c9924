// Motions that almost touch: gaps from one unit in the last place to a thousandth of the size.
#include "tests/queries/random_query.hpp"
#include "tests/scenes/families.hpp"

namespace onset::scenes {

// Two parallel planes that keep one unit in the last place between them; everything else slides inside its
// plane.
static Query coplanar_near_miss(PairKind kind, Random& random) {
  Query query = mixed_query(kind, random);
  const double size = power_of_ten(random, -6, 6);
  for (auto* points : {&query.t0, &query.t1}) {
    const double level = uniform(random, 0.5, 1) * size, above = std::nextafter(level, 2 * size);
    for (int i = 0; i < 4; ++i)
      (*points)[i] = {(*points)[i][0] * size, (*points)[i][1] * size, i < first_body(kind) ? above : level};
  }
  return transformed(query, signed_permutation(random));
}

// Stops at a gap of 2^-30 .. 2^-52 of the size above the plane of the other, which is at z = 0.
static Query near_miss(PairKind kind, Random& random) {
  Query query = mixed_query(kind, random);
  const double gap = std::ldexp(1.0, -integer(random, 30, 52));
  for (int i = 0; i < 4; ++i) {
    const bool first = i < first_body(kind);
    query.t0[i][2] = first ? uniform(random, 0.1, 1) : 0;
    query.t1[i][2] = first ? gap : 0;
  }
  query = scaled(query, std::ldexp(1.0, integer(random, -40, 40)));
  return transformed(query, signed_permutation(random));
}

// As above in any direction, rounded: the gap may have closed.
static Query near_miss_turned(PairKind kind, Random& random) {
  const Query query = near_miss(kind, random);
  const Matrix turn = rotation(random, uniform(random, 0, 3));
  return moved(transformed(query, turn), point(random));
}

// Passes a corner of the other primitive at a relative distance of 2^-20 .. 2^-52.
static Query passing_corner(PairKind kind, Random& random) {
  Query query = random_query(kind, random);
  const Point off = point(random, std::ldexp(1.0, -integer(random, 20, 52)));
  aim(query, unit(random), 0, 0);
  for (auto* points : {&query.t0, &query.t1})
    for (int i = 0; i < first_body(kind); ++i) (*points)[i] = plus((*points)[i], off);
  return query;
}

// Relative vectors in a frame whose z axis is the normal, then turned and moved: `gap` at t = 0 and t = 1.
static Query laid_flat(PairKind kind, Random& random, const Relative& r0, const Relative& r1) {
  Query query;
  query.kind = kind;
  const Matrix turn = rotation(random, uniform(random, 0, 3));
  const Point base = point(random, power_of_ten(random, -1, 2));
  query.t0 = placed(kind, {product(turn, r0.q), product(turn, r0.a), product(turn, r0.b)}, base);
  query.t1 = placed(kind, {product(turn, r1.q), product(turn, r1.a), product(turn, r1.b)}, base);
  return query;
}

// Nearly parallel edges that slide along each other, or a vertex over a face, at a gap of 1e-3 .. 1e-9.
static Query sliding(PairKind kind, Random& random) {
  const double gap = power_of_ten(random, -9, -3), skew = power_of_ten(random, -9, -2);
  const Point a{1, 0, 0};
  const Point b = kind == PairKind::edge_edge ? Point{coin(random) ? 1.0 : -1.0, uniform(random, -skew, skew),
                                                      uniform(random, -skew, skew)}
                                              : Point{uniform(random, 0, 1), 1, 0};
  const double side = kind == PairKind::edge_edge ? gap : 0.5;
  const Point q0{uniform(random, -1.5, 0), uniform(random, -side, side), gap};
  const Point q1{uniform(random, 0, 1.5), uniform(random, -side, side), gap * uniform(random, -0.2, 2)};
  return laid_flat(kind, random, {q0, a, b}, {q1, a, b});
}

// Resting contact: a small gap, and a step of the size of the gap towards the other or along it.
static Query resting(PairKind kind, Random& random) {
  const double gap = power_of_ten(random, -9, -3), tangential = gap * power_of_ten(random, -1, 3);
  const Point a = plus({1, 0, 0}, {uniform(random, -0.3, 0.3), uniform(random, -0.3, 0.3), 0});
  const Point b = plus({0, 1, 0}, {uniform(random, -0.3, 0.3), uniform(random, -0.3, 0.3), 0});
  const double u = uniform(random, 0, 0.6), v = uniform(random, 0, 0.6);
  const Point q = plus(plus(times(u, a), times(v, b)), {0, 0, gap});
  const auto shaken = [&](const Point& p) { return plus(p, point(random, tangential)); };
  Point q1 = shaken(q);
  q1[2] = gap * uniform(random, -1, 2);
  const double tilt = gap / 4;
  return laid_flat(
      kind, random, {q, a, b},
      {q1, plus(a, {0, 0, uniform(random, -tilt, tilt)}), plus(b, {0, 0, uniform(random, -tilt, tilt)})});
}

// Two vertices 1e-10 .. 1e-4 apart that travel together while their primitives turn.
static Query nearly_coincident(PairKind kind, Random& random) {
  Query query = random_query(kind, random);
  const int target = first_body(kind);
  query.t0[0] = plus(query.t0[target], point(random, power_of_ten(random, -10, -4)));
  const Matrix turn = rotation(random, uniform(random, 0, 3)),
               other = rotation(random, uniform(random, 0, 3));
  const bool rigid = coin(random);
  const Point pivot = query.t0[target], travel = point(random, power_of_ten(random, -2, 2));
  for (int i = 0; i < 4; ++i)
    query.t1[i] =
        plus(plus(pivot, travel), product(rigid || i < target ? turn : other, minus(query.t0[i], pivot)));
  return query;
}

std::vector<Family> gap_families() {
  return {{"coplanar_near_miss", coplanar_near_miss, Expect::free},
          {"near_miss", near_miss, Expect::free},
          {"near_miss_turned", near_miss_turned},
          {"passing_corner", passing_corner},
          {"sliding", sliding},
          {"resting", resting},
          {"nearly_coincident", nearly_coincident}};
}

}  // namespace onset::scenes
