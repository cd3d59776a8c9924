#include "tests/oracle/oracle.hpp"

#include <limits>

#include "tests/oracle/arithmetic/exact_points.hpp"
#include "tests/oracle/contact.hpp"
#include "tests/oracle/distance.hpp"

namespace onset::oracle {

// In units that make all coordinates integers: no denominators to reduce. Contact does not depend on the
// unit.
static FirstContact<Rational> first_contact(const scenes::Query& query) {
  const Rational scale = unit_scale(query);
  return {query.kind, exact(query.t0, scale), exact(query.t1, scale)};
}

static Truth truth(const std::optional<Bracket>& t) { return t ? Truth{true, t->lo, t->hi} : Truth{}; }

Truth exact_ccd(const scenes::Query& query) { return truth(first_contact(query).time()); }
Truth exact_ccd_after_start(const scenes::Query& query) {
  return truth(first_contact(query).time_after_start());
}
Truth exact_ccd(const VertexFaceQuery& query) {
  return exact_ccd(scenes::Query{PairKind::vertex_face, query.t0, query.t1});
}
Truth exact_ccd(const EdgeEdgeQuery& query) {
  return exact_ccd(scenes::Query{PairKind::edge_edge, query.t0, query.t1});
}

static Relative<Rational> at(const scenes::Query& query, double t) {
  const auto x0 = exact(query.t0, 1), x1 = exact(query.t1, 1);
  std::array<Vector<Rational>, 4> x;
  for (int i = 0; i < 4; ++i) x[i] = x0[i] - scaled<Rational>(t, x0[i] - x1[i]);
  return relative(query.kind, x);
}

static Rational squared_distance(const Relative<Rational>& r) {
  const Vector<Rational> d = shortest_difference(r);
  return dot(d, d);
}

int compare_distance(const scenes::Query& query, double t, double d, Norm norm) {
  const Relative<Rational> r = at(query, t);
  const Rational bound(d);
  if (norm == Norm::maximum) return sign<Rational>(maximum_norm_distance(r) - bound);
  return sign<Rational>(squared_distance(r) - bound * bound);
}

// The square root of x >= 0, rounded down and up.
static Bracket square_root(const Rational& x) {
  std::uint64_t lo = 0, hi = bits(std::numeric_limits<double>::max());  // lo^2 <= x < hi^2
  while (lo + 1 < hi) {
    const std::uint64_t middle = lo + (hi - lo) / 2;
    const Rational m(from_bits(middle));
    (m * m <= x ? lo : hi) = middle;
  }
  const Rational root(from_bits(lo));
  return {from_bits(lo), root * root == x ? from_bits(lo) : from_bits(hi)};
}

Bracket distance(const scenes::Query& query, double t, Norm norm) {
  const Relative<Rational> r = at(query, t);
  if (norm == Norm::euclidean) return square_root(squared_distance(r));
  const Rational d = maximum_norm_distance(r);
  return {round_down(d), round_up(d)};
}

Bracket distance2(const scenes::Query& query, double t) {
  const Rational d2 = squared_distance(at(query, t));
  return {round_down(d2), round_up(d2)};
}

}  // namespace onset::oracle
