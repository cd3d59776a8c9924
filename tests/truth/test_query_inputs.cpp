// Input that no simulator means to give: options out of range throw, positions out of range are outcomes,
// zeros have no sign.
#include <limits>
#include <stdexcept>

#include "tests/catch.hpp"
#include "tests/oracle/promises.hpp"

using namespace onset;
using scenes::Query;

constexpr PairKind kKinds[] = {PairKind::vertex_face, PairKind::edge_edge};
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN(), kInfinity = INFINITY;

static Query ordinary(PairKind kind, std::uint64_t seed = 5) {
  scenes::Random random(seed);
  return scenes::families().front().make(kind, random);
}

TEST_CASE("options out of range are invalid arguments", "[unit]") {
  std::vector<Options> bad;
  for (double x : {0.0, -0.0, -1e-3, kNaN, kInfinity}) {
    bad.emplace_back().tolerance = x;
    bad.emplace_back().relative_tolerance = x;
  }
  for (double x : {-0x1p-1074, -0.1, kNaN, kInfinity}) bad.emplace_back().min_separation = x;
  for (std::int64_t x : {std::int64_t(0), std::int64_t(-1), std::numeric_limits<std::int64_t>::min()})
    bad.emplace_back().max_checks = x;
  bad.emplace_back().threads = -1;
  for (PairKind kind : kKinds)
    for (const Options& options : bad)
      CHECK_THROWS_AS(scenes::ccd(ordinary(kind), options), std::invalid_argument);
}

TEST_CASE("tolerances and separations at the limits are answered", "[unit]") {
  for (PairKind kind : kKinds)
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      const Query query = ordinary(kind, seed);
      const oracle::Truth truth = oracle::exact_ccd(query);
      Options options;
      options.max_checks = 20000;
      for (double tolerance : {1e-16, 0x1p-1074, 1e-300, 1e300}) {
        options.tolerance = tolerance;
        const QueryResult result = scenes::ccd(query, options);
        INFO(to_text(query) << " " << oracle::to_text(options, result));
        CHECK(oracle::broken_promise(query, options, result, oracle::known(truth)) == "");
      }
      options.tolerance.reset();
      options.min_separation = -0.0;
      CHECK(scenes::ccd(query, options).collides() == scenes::ccd(query).collides());
    }
}

TEST_CASE("NaN, infinity and coordinates beyond 2^1020 are outcomes, wherever they stand", "[unit]") {
  for (PairKind kind : kKinds)
    for (int at = 0; at < 24; ++at) {
      const auto with = [&](double x) {
        Query query = ordinary(kind);
        (at < 12 ? query.t0 : query.t1)[at % 12 / 3][at % 3] = x;
        return scenes::ccd(query);
      };
      for (double x : {kNaN, -kNaN, kInfinity, -kInfinity}) {
        CHECK(with(x).outcome == PairOutcome::non_finite);
        CHECK(with(x).toi == 0);
      }
      for (double x : {std::nextafter(0x1p1020, kInfinity), -std::numeric_limits<double>::max()}) {
        CHECK(with(x).outcome == PairOutcome::out_of_range);
        CHECK(with(x).toi == 0);
      }
      for (double x : {0x1p1020, -0x1p1020}) {
        const PairOutcome outcome = with(x).outcome;
        CHECK(outcome != PairOutcome::out_of_range);
        CHECK(outcome != PairOutcome::non_finite);
      }
    }
}

TEST_CASE("all coordinates at the limit of the range", "[property][oracle]") {
  scenes::Random random(9);
  for (PairKind kind : kKinds)
    for (int i = 0; i < 300; ++i) {
      Query query;
      query.kind = kind;
      for (auto* points : {&query.t0, &query.t1})
        for (Point& p : *points)
          for (double& x : p) x = scenes::integer(random, -1, 1) * 0x1p1020;
      const Options options;
      const QueryResult result = scenes::ccd(query, options);
      INFO(to_text(query) << " " << oracle::to_text(options, result));
      const oracle::Truth truth = oracle::exact_ccd(query);
      CHECK(result.toi >= 0);
      if (truth.collides) CHECK(result.collides());
      if (truth.collides) CHECK(result.toi <= truth.toi_lo);
    }
}

TEST_CASE("the sign of a zero does not matter", "[property]") {
  scenes::Random random(4);
  for (const scenes::Family& family : scenes::families()) {
    const std::string name = family.name;
    if (name != "small_integers" && name != "collinear" && name != "coplanar" && name != "tangent") continue;
    for (PairKind kind : kKinds)
      for (int i = 0; i < 50; ++i) {
        const Query query = family.make(kind, random);
        const Query other = mapped(query, [&](Point p) {
          for (double& x : p)
            if (x == 0) x = scenes::coin(random) ? 0.0 : -0.0;
          return p;
        });
        const QueryResult a = scenes::ccd(query), b = scenes::ccd(other);
        INFO(to_text(other));
        CHECK(a.outcome == b.outcome);
        CHECK(a.toi == b.toi);
        CHECK(a.checks == b.checks);
      }
  }
}

TEST_CASE("points that all coincide touch at once", "[unit]") {
  for (PairKind kind : kKinds)
    for (double x : {0.0, -0.0, 1.0, 0.1, 1e-310, 1e300}) {
      Query query;
      query.kind = kind;
      query = mapped(query, [&](const Point&) { return Point{x, -x, x}; });
      const QueryResult result = scenes::ccd(query);
      CHECK(result.collides());
      CHECK(result.toi == 0);
    }
}
