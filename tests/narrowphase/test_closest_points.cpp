// Closest points, their direction and the certified bounds of the distance, against exact arithmetic.
//
// ONSET_FUZZ=1000 for a long run, ONSET_SEED=n for other pairs.
#include "base/unit_roundoff.hpp"
#include "narrowphase/distance/closest_points.hpp"
#include "tests/catch.hpp"
#include "tests/fuzz.hpp"
#include "tests/narrowphase/exact/exact_pair.hpp"
#include "tests/narrowphase/hard_pairs.hpp"
#include "tests/oracle/distance.hpp"
#include "tests/queries/random_query.hpp"
#include "tests/scenes/families.hpp"

using namespace onset;
using namespace onset::tests;
using scenes::Query;
using scenes::Random;

namespace {

std::uint64_t seed() {
  const char* text = std::getenv("ONSET_SEED");
  return text != nullptr ? std::strtoull(text, nullptr, 10) : 1;
}

Rational power(int exponent) {
  const Rational half = Rational(1) / 2, two = 2;
  Rational r = 1;
  for (int i = 0; i < std::abs(exponent); ++i) r *= exponent < 0 ? half : two;
  return r;
}

// The pair in exact arithmetic, in units that bring its largest corner difference near 1.
struct Truth {
  PairKind kind;
  Rational scale;
  std::array<RationalVector, 4> x;
  std::vector<RationalVector> corners;
  Rational distance2;
  double rho = 0;  // a little above the largest corner difference
  Rational last;   // 2^-1073 of the model

  Truth(PairKind k, const std::array<RationalVector, 4>& positions) : kind(k), x(positions) {
    const int side = scenes::first_body(kind);
    Rational largest = 0;
    for (int i = 0; i < side; ++i)
      for (int j = side; j < 4; ++j)
        for (const Rational& c : x[std::size_t(i)] - x[std::size_t(j)])
          largest = std::max<Rational>(largest, abs(c));
    scale = 1;
    const Rational step = power(64);
    while (largest != 0 && largest * scale < Rational(0x1p-64)) scale *= step;
    while (largest * scale > Rational(0x1p64)) scale /= step;
    for (RationalVector& p : x) p = oracle::scaled<Rational>(scale, p);
    for (int i = 0; i < side; ++i)
      for (int j = side; j < 4; ++j) {
        corners.push_back(x[std::size_t(i)] - x[std::size_t(j)]);
        rho = std::max(
            rho, std::sqrt(static_cast<double>(Rational(dot(corners.back(), corners.back())))) * (1 + 1e-15));
      }
    const RationalVector d = oracle::shortest_difference(oracle::relative<Rational>(kind, x));
    distance2 = dot(d, d);
    last = scale * power(-1073);
  }

  double model_rho() const { return static_cast<double>(Rational(rho) / scale); }
  Rational length(double model) const { return Rational(model) * scale; }
  // Whether model - slack rho <= distance, and model + slack rho >= distance.
  bool is_at_most(double model, double slack) const {
    const Rational r = length(model) - Rational(slack * rho) - last;
    return r <= 0 || r * r <= distance2;
  }
  bool is_at_least(double model, double slack) const {
    const Rational r = length(model) + Rational(slack * rho) + last;
    return r >= 0 && r * r >= distance2;
  }
};

std::array<RationalVector, 4> exact(const PairPoints& x) {
  return {tests::exact(x[0]), tests::exact(x[1]), tests::exact(x[2]), tests::exact(x[3])};
}

// Weights are feasible and sum to exactly 1 and -1; the returned difference of their points is in the truth's
// units.
RationalVector check_weights(const Truth& truth, const ClosestPoints& found) {
  const int side = scenes::first_body(truth.kind);
  double sums[2] = {0, 0};
  RationalVector w{0, 0, 0};
  for (int i = 0; i < 4; ++i) {
    REQUIRE((i < side ? found.weights[i] >= 0 : found.weights[i] <= 0));
    CHECK(std::ldexp(found.weights[i], 52) == std::floor(std::ldexp(found.weights[i], 52)));
    sums[i >= side] += found.weights[i];
    w = plus(w, oracle::scaled<Rational>(Rational(found.weights[i]), truth.x[std::size_t(i)]));
  }
  CHECK(sums[0] == 1);
  CHECK(sums[1] == -1);
  return w;
}

// Held fixed, the direction keeps the pair apart by what it says.
void check_direction(const Truth& truth, const ClosestPoints& found) {
  const RationalVector n = tests::exact(found.direction);
  const Rational nn = dot(n, n);
  if (found.lower > 0) REQUIRE(nn > 0);
  if (nn > 0) CHECK(std::fabs(std::sqrt(static_cast<double>(nn)) - 1) <= 8 * kU);
  if (found.lower == 0) return;
  Rational least = dot(n, truth.corners[0]);
  for (const RationalVector& c : truth.corners) least = std::min<Rational>(least, dot(n, c));
  CHECK(least >= truth.length(found.lower) - Rational(16 * kU * truth.rho) - truth.last);
}

void check(const Truth& truth, const ClosestPoints& found) {
  const RationalVector w = check_weights(truth, found);
  CAPTURE(found.distance, found.lower, found.upper, truth.rho, static_cast<double>(truth.distance2),
          static_cast<double>(truth.scale));
  CHECK(truth.is_at_most(found.lower, 0));
  CHECK(truth.is_at_least(found.upper, 0));
  CHECK(truth.is_at_most(found.distance, 48 * kU));
  CHECK(truth.is_at_least(found.distance, 48 * kU));
  CHECK(truth.length(found.upper) - truth.length(found.lower) <=
        Rational(64 * kU * truth.rho) + 4 * truth.last);
  if (truth.distance2 > Rational(0x1p-94 * truth.rho * truth.rho) &&
      truth.distance2 > 64 * truth.last * truth.last)
    CHECK(found.lower > 0);
  const double of_weights = std::sqrt(static_cast<double>(Rational(dot(w, w))));
  CHECK(std::fabs(of_weights - static_cast<double>(truth.length(found.distance))) <=
        16 * kU * truth.rho + static_cast<double>(truth.last));
  check_direction(truth, found);
}

ClosestPoints closest(PairKind kind, const PairPoints& p) {
  const double* const x[4] = {p[0].data(), p[1].data(), p[2].data(), p[3].data()};
  return closest_points(kind, x);
}
ClosestPoints closest(const Query& q, double t) {
  const double* const x0[4] = {q.t0[0].data(), q.t0[1].data(), q.t0[2].data(), q.t0[3].data()};
  const double* const x1[4] = {q.t1[0].data(), q.t1[1].data(), q.t1[2].data(), q.t1[3].data()};
  return closest_points(q.kind, x0, x1, t);
}
void check(PairKind kind, const PairPoints& x) {
  INFO(scenes::to_text({kind, x, x}));
  check(Truth(kind, exact(x)), closest(kind, x));
}

void check_many(PairPoints (*make)(PairKind, Random&), int count, std::uint64_t which) {
  for (const PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
    Random random(seed() * 100 + 2 * which + (kind == PairKind::edge_edge));
    for (int i = 0; i < fuzz(count); ++i) check(kind, placed(make(kind, random), random));
  }
}

}  // namespace

TEST_CASE("closest points of the degenerate families, at both ends and between", "[oracle]") {
  for (const scenes::Family& family : scenes::families())
    for (const PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
      Random random = scenes::seeded(family, kind, seed() + 2);
      for (int i = 0; i < fuzz(20); ++i) {
        const Query query = family.make(kind, random);
        CAPTURE(family.name, i, scenes::name(kind));
        check(kind, query.t0);
        check(kind, query.t1);
      }
    }
}

TEST_CASE("closest points of pairs in general position are exact up to rounding", "[oracle]") {
  Random random(seed() + 10);
  for (const PairKind kind : {PairKind::vertex_face, PairKind::edge_edge})
    for (int i = 0; i < fuzz(1000); ++i) {
      Query query = scenes::random_query(kind, random);
      if (i % 2) scenes::aim(query, 0, scenes::unit(random) / 2, scenes::unit(random) / 2);
      if (i % 4 == 3) query.t0[0][std::size_t(i % 3)] += scenes::power_of_ten(random, -12, -1);
      check(kind, query.t0);
    }
}

TEST_CASE("feet that tie cost no more than rounding", "[oracle][property]") { check_many(tie, 600, 0); }
TEST_CASE("needles cost no more than rounding", "[oracle][property]") { check_many(needle, 600, 1); }
TEST_CASE("nearly parallel edges cost no more than rounding", "[oracle][property]") {
  check_many(parallel, 600, 2);
}
TEST_CASE("primitives without extent have closest points", "[oracle][property]") {
  check_many(degenerate, 400, 3);
}
TEST_CASE("closest points of small integers", "[oracle][property]") { check_many(lattice, 400, 4); }
TEST_CASE("gaps are certified far below the rounding of doubles", "[oracle][property]") {
  check_many(near_touching, 400, 5);
  int apart = 0, certified = 0;
  Random random(seed() + 60);
  for (const PairKind kind : {PairKind::vertex_face, PairKind::edge_edge})
    for (int i = 0; i < fuzz(400); ++i) {
      const PairPoints x = near_touching(kind, random);
      const Truth truth(kind, exact(x));
      const bool small = truth.distance2 < Rational(0x1p-94 * truth.rho * truth.rho);
      if (!small || truth.distance2 < Rational(0x1p-170 * truth.rho * truth.rho)) continue;
      ++apart;
      certified += closest(kind, x).lower > 0;
    }
  CAPTURE(apart, certified);
  CHECK(certified >= apart - apart / 100);
}

TEST_CASE("closest points at a time are those of the exact motion", "[oracle][property]") {
  PairPoints (*const makers[])(PairKind, Random&) = {tie,        needle,  parallel,
                                                     degenerate, lattice, near_touching};
  for (const PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
    Random random(seed() * 100 + 50);
    for (int i = 0; i < fuzz(600); ++i) {
      const auto make = makers[std::size_t(i % 6)];
      Query q{kind, make(kind, random), make(kind, random)};
      if (i % 3 == 0) q.t1 = scenes::random_query(kind, random).t0;
      if (i % 3 == 1) q = scenes::mixed_query(kind, random);
      const double t = i % 7 == 0 ? 0 : i % 7 == 1 ? 1 : i % 7 == 2 ? 0.5 : scenes::unit(random);
      std::array<RationalVector, 4> x;
      for (std::size_t k = 0; k < 4; ++k)
        x[k] = between(tests::exact(q.t0[k]), tests::exact(q.t1[k]), Rational(t));
      INFO(scenes::to_text(q));
      CAPTURE(t);
      Truth truth(kind, x);
      const double motion =
          std::max(Truth(kind, exact(q.t0)).model_rho(), Truth(kind, exact(q.t1)).model_rho());
      truth.rho = std::max(truth.rho, 0x1p-40 * static_cast<double>(truth.length(motion)));
      check(truth, closest(q, t));
    }
  }
}

TEST_CASE("a vertex above a corner that ties has the whole distance", "[unit]") {
  const PairPoints x{Point{0, 0, 0x1.4p-8}, Point{0, 0, 0}, Point{1, 0, 0x1.4p-27}, Point{0, 1, -1}};
  const ClosestPoints found = closest(PairKind::vertex_face, x);
  CHECK(found.lower >= 0x1.3ffffffffff00p-8);
  CHECK(found.upper <= 0x1.4000000000100p-8);
}

TEST_CASE("a vertex beside a needle has its distance to the needle's side", "[unit]") {
  const PairPoints x{Point{-0x1.1a1904b081edep-8, -0x1.11a7dcb91c158p-3, -0x1.15336b771baa1p-3},
                     Point{0, 0, 0},
                     Point{-0x1.72b3e87a83dcp-6, -0x1.679bf272af91dp-1, -0x1.6c44900134754p-1},
                     Point{-0x1.cd39571109748p-9, -0x1.bf6be4f6a653p-4, -0x1.c537bb7bd54c9p-4}};
  const ClosestPoints found = closest(PairKind::vertex_face, x);
  CHECK(std::fabs(found.distance - 6.99102e-14) < 1e-15);
  CHECK(std::fabs(found.lower - 6.99102e-14) < 1e-15);
}
