#include "tests/queries/random_query.hpp"

#include <algorithm>

namespace onset::scenes {

Query random_query(PairKind kind, Random& random) {
  Query query;
  query.kind = kind;
  for (Point& p : query.t0) p = point(random);
  for (Point& p : query.t1) p = point(random);
  return query;
}

static void shift_first(Query& query, const Point& offset) {
  for (int i = 0; i < first_body(query.kind); ++i) {
    query.t0[i] = plus(query.t0[i], offset);
    query.t1[i] = plus(query.t1[i], offset);
  }
}

void aim(Query& query, double t, double u, double v) {
  shift_first(query, times(-1, separation(query, t, u, v)));
}

Query interior_query(PairKind kind, Random& random) {
  Query query = random_query(kind, random);
  const double u = uniform(random, 0.02, 0.96);
  const double v =
      kind == PairKind::edge_edge ? uniform(random, 0.02, 0.96) : uniform(random, 0.01, 0.98 - u);
  aim(query, uniform(random, 0.02, 0.98), u, v);
  return query;
}

Query mixed_query(PairKind kind, Random& random) {
  Query query = interior_query(kind, random);
  if (coin(random)) shift_first(query, point(random, power_of_ten(random, -3, 1)));
  return query;
}

Query grid_query(PairKind kind, Random& random, int bits) {
  Query query;
  query.kind = kind;
  for (Point& p : query.t0) p = grid_point(random, bits);
  for (Point& p : query.t1) p = grid_point(random, bits);
  return query;
}

Matrix integer_matrix(Random& random) {
  Matrix m;
  for (Point& row : m)
    for (double& x : row) x = integer(random, -3, 3);
  return m;
}

Matrix rotation(Random& random, double angle) {
  Point n = point(random);
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  n = length > 0 ? times(1 / length, n) : Point{0, 0, 1};
  const double c = std::cos(angle), s = std::sin(angle);
  const Matrix cross{{{0, -n[2], n[1]}, {n[2], 0, -n[0]}, {-n[1], n[0], 0}}};
  Matrix m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m[i][j] = (i == j ? c : 0) + s * cross[i][j] + (1 - c) * n[i] * n[j];
  return m;
}

Matrix signed_permutation(Random& random) {
  std::array<int, 3> axes{0, 1, 2};
  for (int i = 2; i > 0; --i) std::swap(axes[i], axes[integer(random, 0, i)]);
  Matrix m{};
  for (int i = 0; i < 3; ++i) m[i][axes[i]] = coin(random) ? 1 : -1;
  return m;
}

}  // namespace onset::scenes
