// Primitives and motions for which the coplanarity cubic vanishes, or the primitive has no normal.
#include "tests/queries/random_query.hpp"
#include "tests/scenes/families.hpp"

namespace onset::scenes {

static Query small_integers(PairKind kind, Random& random) {
  Query query;
  query.kind = kind;
  for (auto* points : {&query.t0, &query.t1})
    for (Point& p : *points)
      for (double& x : p) x = integer(random, -2, 2);
  return query;
}

// No motion: random, on a coarse grid, or one that touches at quarters of the sides, exactly.
static Query at_rest(PairKind kind, Random& random) {
  Query query = mixed_query(kind, random);
  const int how = integer(random, 0, 3);
  if (how == 1) query = small_integers(kind, random);
  if (how >= 2) {
    const Point a = times(4, grid_point(random, 20)), b = times(4, grid_point(random, 20));
    const int u = integer(random, -1, 4), v = integer(random, 0, 4);
    query.t0 = placed(kind, {plus(times(u / 4.0, a), times(v / 4.0, b)), a, b}, grid_point(random, 30));
  }
  query.t1 = query.t0;
  return query;
}

// A face with two nearly parallel sides, or two nearly parallel edges.
static Query sliver(PairKind kind, Random& random) {
  Query query = random_query(kind, random);
  const double width = power_of_ten(random, -14, -6);
  for (auto* x : {&query.t0, &query.t1}) {
    const Point along = minus((*x)[3], (*x)[2]), off = point(random, width);
    if (kind == PairKind::vertex_face)
      (*x)[1] = plus(lerp((*x)[2], (*x)[3], unit(random)), off);
    else
      (*x)[1] = plus((*x)[0], plus(times(uniform(random, 0.5, 2), along), off));
  }
  const double t = unit(random), u = unit(random) / 2, v = unit(random) / 2;
  aim(query, t, u, v);
  return query;
}

// The face stays a segment (exactly), or edge a stays parallel to edge b (exactly), while everything moves
// and turns. Some meet at t = 1/4, 1/2 or 1.
static Query zero_area(PairKind kind, Random& random) {
  Query query;
  query.kind = kind;
  const int along = integer(random, -3, 3), at = integer(random, -1, 6);
  const Point off = integer(random, 0, 4) == 0 ? Point{} : grid_point(random, 18);
  const double beyond[] = {1, 0, -1, -3};
  const double last = beyond[integer(random, 0, 3)];
  for (int end = 0; end < 2; ++end) {
    const Point a = times(4, grid_point(random, 18));
    const Point q = plus(times(at / 4.0, a), times(end ? last : 1, off));
    (end ? query.t1 : query.t0) = placed(kind, {q, a, times(along, a)}, grid_point(random, 20));
  }
  return query;
}

// One or both edges are points; two or all three corners of the face coincide. Most meet exactly, at t = 1/2.
static Query zero_length(PairKind kind, Random& random) {
  Query query;
  query.kind = kind;
  const bool both = integer(random, 0, 2) == 0, swapped = coin(random), meets = integer(random, 0, 3) != 0;
  const Point side = grid_point(random, 20);
  const int at = integer(random, 0, 4);
  for (int end = 0; end < 2; ++end) {
    const Point zero{}, b = both ? zero : times(4, grid_point(random, 18));
    Point q = plus(times(at / 4.0, b), times(end ? 1 : -1, side));
    if (!meets) q = plus(q, grid_point(random, 18));
    (end ? query.t1 : query.t0) =
        placed(kind, swapped ? Relative{q, b, zero} : Relative{q, zero, b}, grid_point(random, 20));
  }
  return query;
}

// Edges that stay parallel while they approach; a vertex that stays in a plane parallel to the face.
static Query parallel(PairKind kind, Random& random) {
  Query query;
  query.kind = kind;
  const Point a = grid_point(random, 20), other = grid_point(random, 20);
  const Point b = kind == PairKind::edge_edge ? times(integer(random, -2, 2), a) : other;
  const Point direction =
      point(random, power_of_ten(random, -10, 6));  // drawn in this order by every compiler
  const Point height = times(integer(random, 0, 2), direction);
  for (int end = 0; end < 2; ++end) {
    const double u = integer(random, -2, 2) / 2.0, v = integer(random, -2, 2) / 2.0;
    const Point in_plane = plus(times(u, a), times(v, b));
    (end ? query.t1 : query.t0) = placed(kind, {plus(in_plane, height), a, b}, grid_point(random, 10));
  }
  return query;
}

// Parallel segments that meet along a line at t = 1/2 while they turn: coplanar for all t.
static Query parallel_meeting(PairKind kind, Random& random) {
  Query query;
  query.kind = kind;
  const Point side = grid_point(random, 20);
  const int along = integer(random, -2, 2), at = integer(random, -3, 8);
  for (int end = 0; end < 2; ++end) {
    const Point a = times(8, grid_point(random, 20));
    const Point q = plus(times(at / 8.0, a), times(end ? 1 : -1, side));
    (end ? query.t1 : query.t0) = placed(kind, {q, a, times(along, a)}, grid_point(random, 20));
  }
  return query;
}

// Edges that are parallel, or a face that is a segment, at the moment of contact only, t = 1/2: all points on
// one line then.
static Query collapsing(PairKind kind, Random& random) {
  Query query;
  query.kind = kind;
  const Point line = times(4, grid_point(random, 18));
  const Point da = grid_point(random, 18), db = grid_point(random, 18), dq = grid_point(random, 18);
  const int along = integer(random, -2, 2), at = integer(random, -5, 10);
  for (double s : {-1.0, 1.0}) {
    const Point a = plus(line, times(s, da)), b = plus(times(along, line), times(s, db));
    const Point q = plus(times(at / 4.0, line), times(s, dq));
    (s > 0 ? query.t1 : query.t0) = placed(kind, {q, a, b}, grid_point(random, 30));
  }
  return query;
}

// All points on one line for all t.
static Query collinear(PairKind kind, Random& random) {
  Query query;
  query.kind = kind;
  const Point direction = grid_point(random, 20), base = grid_point(random, 30);
  const int spread = coin(random) ? 8 : 1000;
  for (auto* points : {&query.t0, &query.t1})
    for (Point& p : *points) p = plus(base, times(integer(random, -spread, spread), direction));
  return query;
}

// All points in one plane for all t: the grid, sheared; or any coordinates in an axis plane.
static Query coplanar(PairKind kind, Random& random) {
  const bool full = coin(random);
  Query query = full ? mixed_query(kind, random) : grid_query(kind, random, integer(random, 1, 20));
  const double level = full ? uniform(random, -1, 1) : 0;
  query = mapped(query, [=](const Point& p) { return Point{p[0], p[1], level}; });
  return transformed(query, full ? signed_permutation(random) : integer_matrix(random));
}

// The plane of all four points turns; in it, q slides along a side of the primitive.
static Query coplanar_turning(PairKind kind, Random& random) {
  Query query;
  query.kind = kind;
  const Point a = times(4, grid_point(random, 15));
  const double along_b = integer(random, -1, 5) / 4.0;
  for (int end = 0; end < 2; ++end) {
    const Point b = times(4, grid_point(random, 15));
    const Point q = plus(times(integer(random, -8, 8) / 4.0, a), times(along_b, b));
    (end ? query.t1 : query.t0) = placed(kind, {q, a, b}, grid_point(random, 30));
  }
  return query;
}

// A vertex that two primitives share, as neighbours in a mesh do.
static Query shared_vertex(PairKind kind, Random& random) {
  Query query = random_query(kind, random);
  const int target = first_body(kind) + integer(random, 0, 1);
  query.t0[0] = query.t0[target], query.t1[0] = query.t1[target];
  return query;
}

std::vector<Family> degenerate_families() {
  return {{"small_integers", small_integers},
          {"static", at_rest},
          {"sliver", sliver},
          {"zero_area", zero_area},
          {"zero_length", zero_length},
          {"parallel", parallel},
          {"parallel_meeting", parallel_meeting},
          {"collapsing", collapsing},
          {"collinear", collinear},
          {"coplanar", coplanar},
          {"coplanar_turning", coplanar_turning},
          {"shared_vertex", shared_vertex, Expect::contact}};
}

}  // namespace onset::scenes
