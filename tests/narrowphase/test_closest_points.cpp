// Closest points and the certified bound of a distance, against exact arithmetic.
#include "narrowphase/closest_points.hpp"
#include "tests/catch.hpp"
#include "tests/narrowphase/exact_pair.hpp"
#include "tests/oracle/distance.hpp"
#include "tests/scenes/families.hpp"
#include "tests/scenes/random_query.hpp"

using namespace onset;
using namespace onset::tests;
using scenes::Query;
using scenes::Random;

namespace {

Rational squared_distance(PairKind kind, const std::array<Point, 4>& x) {
  const oracle::Relative<Rational> r =
      oracle::relative<Rational>(kind, {exact(x[0]), exact(x[1]), exact(x[2]), exact(x[3])});
  const RationalVector d = oracle::shortest_difference(r);
  return dot(d, d);
}

double size_of(const std::array<Point, 4>& x) {
  double size = 0;
  for (const Point& p : x)
    for (const Point& q : x)
      for (int a = 0; a < 3; ++a) size = std::max(size, std::fabs(p[a] - q[a]));
  return size;
}

// Weights are feasible and sum to 1 and -1, nothing is nearer than `lower`, and the distance is that of the
// weights' points and close to the exact one.
void check(PairKind kind, const std::array<Point, 4>& x) {
  const double* const points[4] = {x[0].data(), x[1].data(), x[2].data(), x[3].data()};
  const ClosestPoints found = closest_points(kind, points);
  const int side = kind == PairKind::vertex_face ? 1 : 2;
  double sums[2] = {0, 0};
  RationalVector w{0, 0, 0};
  for (int i = 0; i < 4; ++i) {
    REQUIRE((i < side ? found.weights[i] >= 0 : found.weights[i] <= 0));
    sums[i >= side] += found.weights[i];
    w = plus(w, oracle::scaled<Rational>(Rational(found.weights[i]), exact(x[std::size_t(i)])));
  }
  CHECK(std::fabs(sums[0] - 1) <= 0x1p-51);
  CHECK(std::fabs(sums[1] + 1) <= 0x1p-51);
  const Rational exact2 = squared_distance(kind, x);
  const double size = size_of(x), distance = std::sqrt(static_cast<double>(exact2));
  if (found.lower > 0) CHECK(Rational(found.lower) * Rational(found.lower) <= exact2);
  CHECK(found.distance >= distance - 0x1p-49 * size - 0x1p-1060);
  CHECK(found.distance <= distance + 1e-7 * size + 0x1p-1060);
  double largest = 0;  // coordinates far from the origin are multiplied by weights that sum to 1 up to 2^-51
  for (const Point& p : x)
    for (const double c : p) largest = std::max(largest, std::fabs(c));
  const double of_weights = std::sqrt(static_cast<double>(Rational(dot(w, w))));
  CHECK(std::fabs(of_weights - found.distance) <= 0x1p-48 * largest + 0x1p-1060);
}

}  // namespace

TEST_CASE("closest points of the degenerate families, at both ends", "[oracle]") {
  for (const scenes::Family& family : scenes::families())
    for (const PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
      Random random = scenes::seeded(family, kind, 3);
      for (int i = 0; i < 60; ++i) {
        const Query query = family.make(kind, random);
        CAPTURE(family.name, i, scenes::name(kind), scenes::to_text(query));
        if (size_of(query.t0) > 1e100 || size_of(query.t1) > 1e100)
          continue;  // sums here, in double, overflow
        if (size_of(query.t0) < 1e-100 || size_of(query.t1) < 1e-100) continue;  // ... and squares underflow
        check(kind, query.t0);
        check(kind, query.t1);
      }
    }
}

TEST_CASE("closest points of pairs in general position are exact up to rounding", "[oracle]") {
  Random random(11);
  for (const PairKind kind : {PairKind::vertex_face, PairKind::edge_edge})
    for (int i = 0; i < 3000; ++i) {
      Query query = scenes::random_query(kind, random);
      if (i % 2) scenes::aim(query, 0, scenes::unit(random) / 2, scenes::unit(random) / 2);
      if (i % 4 == 3) query.t0[0][i % 3] += scenes::power_of_ten(random, -12, -1);
      CAPTURE(i, scenes::name(kind), scenes::to_text(query));
      check(kind, query.t0);
      const double* const x[4] = {query.t0[0].data(), query.t0[1].data(), query.t0[2].data(),
                                  query.t0[3].data()};
      const ClosestPoints found = closest_points(kind, x);
      const double distance = std::sqrt(static_cast<double>(squared_distance(kind, query.t0)));
      if (distance < 1e-3) continue;
      CHECK(std::fabs(found.distance - distance) <= 1e-12 * distance);
      CHECK(found.lower >= distance * (1 - 1e-9));
    }
}
