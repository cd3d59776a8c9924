// Contacts that exist by construction, in exact arithmetic, and are lost by one wrong rounding.
#include "tests/queries/random_query.hpp"
#include "tests/scenes/families.hpp"

namespace onset::scenes {

// A point of the first primitive and a point of the second.
struct Meeting {
  int first, second;
};
static Meeting meeting(PairKind kind, Random& random) {
  if (kind == PairKind::vertex_face) return {0, integer(random, 1, 3)};
  return {integer(random, 0, 1), integer(random, 2, 3)};
}

// Vertex on vertex at exactly one end, all mantissa bits in use, at magnitudes 1e-12 .. 1e12.
static Query touching(PairKind kind, Random& random, bool at_t1) {
  const double size = power_of_ten(random, -12, 12);
  Query query = scaled(random_query(kind, random), size);
  const Meeting m = meeting(kind, random);
  auto& end = at_t1 ? query.t1 : query.t0;
  end[m.first] = end[m.second];
  return query;
}
static Query touching_t0(PairKind kind, Random& random) { return touching(kind, random, false); }
static Query touching_t1(PairKind kind, Random& random) { return touching(kind, random, true); }

// In the interior or on the boundary of both, exactly, at t = 0 or t = 1: (U, V) are quarters, a and b
// multiples of 4.
static Query touching_inside(PairKind kind, Random& random, bool at_t1) {
  Query query = grid_query(kind, random, 40);
  const Point a = times(4, grid_point(random, 40)), b = times(4, grid_point(random, 40));
  const int u = integer(random, 0, 4), v = integer(random, 0, kind == PairKind::edge_edge ? 4 : 4 - u);
  const Point q = plus(times(u / 4.0, a), times(v / 4.0, b));
  (at_t1 ? query.t1 : query.t0) = placed(kind, {q, a, b}, grid_point(random, 40));
  return scaled(query, std::ldexp(1.0, integer(random, -80, 40)));
}
static Query touching_inside_t0(PairKind kind, Random& random) {
  return touching_inside(kind, random, false);
}
static Query touching_inside_t1(PairKind kind, Random& random) { return touching_inside(kind, random, true); }

// One vertex grazes another at t = 1/2: both paths have the midpoint `corner`, exactly.
static Query grazing_vertex(PairKind kind, Random& random) {
  Query query = grid_query(kind, random, 50);
  const Meeting m = meeting(kind, random);
  const Point corner = grid_point(random, 50);
  for (int i : {m.first, m.second}) {
    const Point step = coin(random) ? grid_point(random, 50) : Point{};
    query.t0[i] = minus(corner, step), query.t1[i] = plus(corner, step);
  }
  return scaled(query, std::ldexp(1.0, integer(random, -90, -10)));
}

// A vertex passes through a side of the face, or an end of one edge through the other edge, at t = 1/2
// exactly.
static Query grazing_side(PairKind kind, Random& random) {
  Query query;
  query.kind = kind;
  const int at = integer(random, 0, 4);
  const bool other_side = coin(random);
  const Point side = grid_point(random, 40);
  for (int end = 0; end < 2; ++end) {
    const Point a = times(4, grid_point(random, 40)), b = times(4, grid_point(random, 40));
    const Point q = plus(times(at / 4.0, other_side ? a : b), times(end ? 1 : -1, side));
    (end ? query.t1 : query.t0) = placed(kind, {q, a, b}, grid_point(random, 40));
  }
  return scaled(query, std::ldexp(1.0, integer(random, -80, 40)));
}

// The plane is touched at t = 1/2 and not crossed: f has a double root there. With s = 2t - 1, a = (A, 0, c
// s), b = (0, B, 0), q = (A i/8 + x s, B j/8, c i/8 s): f = det(q, a, b) = -B c x s^2.
static Query tangent(PairKind kind, Random& random) {
  Query query;
  query.kind = kind;
  const int i = integer(random, 0, 8), j = integer(random, 0, kind == PairKind::edge_edge ? 8 : 8 - i);
  const Point size = times(8, grid_point(random, 12));  // A, B, c
  const double x = integer(random, -1000, 1000);
  const Matrix shear = integer_matrix(random);
  for (double s : {-1.0, 1.0}) {
    const Relative r{{size[0] * i / 8 + x * s, size[1] * j / 8, size[2] * i / 8 * s},
                     {size[0], 0, size[2] * s},
                     {0, size[1], 0}};
    const Relative sheared{product(shear, r.q), product(shear, r.a), product(shear, r.b)};
    (s > 0 ? query.t1 : query.t0) = placed(kind, sheared, grid_point(random, 30));
  }
  return scaled(query, std::ldexp(1.0, integer(random, -60, 20)));
}

// The same with one coordinate moved by one unit in the last place: two roots close together, or none.
static Query nearly_tangent(PairKind kind, Random& random) {
  Query query = tangent(kind, random);
  double& x = (coin(random) ? query.t0 : query.t1)[integer(random, 0, 3)][integer(random, 0, 2)];
  x = std::nextafter(x, coin(random) ? INFINITY : -INFINITY);
  return query;
}

std::vector<Family> touching_families() {
  return {{"touching_t0", touching_t0, Expect::contact},
          {"touching_t1", touching_t1, Expect::contact},
          {"touching_inside_t0", touching_inside_t0, Expect::contact},
          {"touching_inside_t1", touching_inside_t1, Expect::contact},
          {"grazing_vertex", grazing_vertex, Expect::contact},
          {"grazing_side", grazing_side, Expect::contact},
          {"tangent", tangent, Expect::contact},
          {"nearly_tangent", nearly_tangent}};
}

}  // namespace onset::scenes
