// Closest points, their direction and the certified bounds of the distance, against exact arithmetic.
//
// ONSET_FUZZ=1000 for a long run, ONSET_SEED=n for other pairs.
#include "narrowphase/closest_points.hpp"
#include "tests/catch.hpp"
#include "tests/narrowphase/exact_pair.hpp"
#include "tests/narrowphase/fuzz.hpp"
#include "tests/oracle/distance.hpp"
#include "tests/scenes/families.hpp"
#include "tests/scenes/random_query.hpp"

using namespace onset;
using namespace onset::tests;
using scenes::Query;
using scenes::Random;

namespace {

constexpr double kU = 0x1p-53;
using Points = std::array<Point, 4>;

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

std::array<RationalVector, 4> exact(const Points& x) {
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

ClosestPoints closest(PairKind kind, const Points& p) {
  const double* const x[4] = {p[0].data(), p[1].data(), p[2].data(), p[3].data()};
  return closest_points(kind, x);
}
ClosestPoints closest(const Query& q, double t) {
  const double* const x0[4] = {q.t0[0].data(), q.t0[1].data(), q.t0[2].data(), q.t0[3].data()};
  const double* const x1[4] = {q.t1[0].data(), q.t1[1].data(), q.t1[2].data(), q.t1[3].data()};
  return closest_points(q.kind, x0, x1, t);
}
void check(PairKind kind, const Points& x) {
  INFO(scenes::to_text({kind, x, x}));
  check(Truth(kind, exact(x)), closest(kind, x));
}

Points mapped(Points x, const std::array<int, 3>& axes, const Point& signs, double scale,
              const Point& offset) {
  for (Point& p : x) {
    Point r;
    for (std::size_t a = 0; a < 3; ++a) r[a] = scale * signs[a] * p[std::size_t(axes[a])] + offset[a];
    p = r;
  }
  return x;
}
double sign(Random& random) { return scenes::coin(random) ? 1 : -1; }

// In any position that keeps ties exact, and now and then in others and far away, at any scale.
Points placed(Points x, Random& random) {
  std::array<int, 3> axes{0, 1, 2};
  std::shuffle(axes.begin(), axes.end(), random);
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

// A point above a corner or a side that two features share, off it by next to nothing, at any height.
Points tie(PairKind kind, Random& random) {
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

// Thinner than anything that is left of a cross product, the other primitive near it.
Points needle(PairKind kind, Random& random) {
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

// Edges at angles from 0 to 1e-6, on one line, side by side, or one above the other.
Points parallel(PairKind kind, Random& random) {
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

// Edges of no length, faces without area, all at one point.
Points degenerate(PairKind kind, Random& random) {
  Points x{scenes::point(random), scenes::point(random), scenes::point(random), scenes::point(random)};
  const std::size_t side = std::size_t(scenes::first_body(kind));
  x[3] = scenes::integer(random, 0, 2) == 0 ? x[2] : scenes::times(scenes::integer(random, -1, 2), x[2]);
  if (scenes::coin(random)) x[1] = x[scenes::coin(random) ? 0 : 2];
  if (scenes::integer(random, 0, 3) == 0)
    x[0] = scenes::plus(x[side], Point{tiny(random), tiny(random), tiny(random)});
  if (scenes::integer(random, 0, 9) == 0) x = {x[0], x[0], x[0], x[0]};
  return x;
}

// Small integers: exact ties, touching and coplanar pairs of every kind.
Points lattice(PairKind kind, Random& random) {
  const Query q = scenes::grid_query(kind, random, 1 + int(scenes::coin(random)));
  return q.t0;
}

// One near the other by anything from a unit to 1e-300.
Points near_touching(PairKind kind, Random& random) {
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

void check_many(Points (*make)(PairKind, Random&), int count, std::uint64_t which) {
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
      const Points x = near_touching(kind, random);
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
  Points (*const makers[])(PairKind, Random&) = {tie, needle, parallel, degenerate, lattice, near_touching};
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
  const Points x{Point{0, 0, 0x1.4p-8}, Point{0, 0, 0}, Point{1, 0, 0x1.4p-27}, Point{0, 1, -1}};
  const ClosestPoints found = closest(PairKind::vertex_face, x);
  CHECK(found.lower >= 0x1.3ffffffffff00p-8);
  CHECK(found.upper <= 0x1.4000000000100p-8);
}

TEST_CASE("a vertex beside a needle has its distance to the needle's side", "[unit]") {
  const Points x{Point{-0x1.1a1904b081edep-8, -0x1.11a7dcb91c158p-3, -0x1.15336b771baa1p-3}, Point{0, 0, 0},
                 Point{-0x1.72b3e87a83dcp-6, -0x1.679bf272af91dp-1, -0x1.6c44900134754p-1},
                 Point{-0x1.cd39571109748p-9, -0x1.bf6be4f6a653p-4, -0x1.c537bb7bd54c9p-4}};
  const ClosestPoints found = closest(PairKind::vertex_face, x);
  CHECK(std::fabs(found.distance - 6.99102e-14) < 1e-15);
  CHECK(std::fabs(found.lower - 6.99102e-14) < 1e-15);
}
