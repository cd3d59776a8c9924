// Minimum separation: pairs that come within it are found, in both norms.
#include "tests/catch.hpp"
#include "tests/oracle/promises.hpp"

using namespace onset;
using scenes::Query;

static void check(const Query& query, const Options& options, const oracle::Known& known, bool judge_zero) {
  const QueryResult result = scenes::ccd(query, options);
  std::string broken = oracle::broken_promise(query, options, result, known);
  if (judge_zero && options.norm == Norm::euclidean && oracle::silent_zero(query, options, result))
    broken = "a step of zero from a start that is apart";
  // Apart until toi: the exact distance at a few times before it, for all the time where it is free.
  const double last = result.outcome == PairOutcome::free ? 1 : std::nextafter(result.toi, 0);
  for (double part : {0.0, 0.5, 0.9, 0.999, 1.0})
    if (broken.empty() && result.toi > 0 &&
        oracle::compare_distance(query, part * last, options.min_separation, options.norm) <= 0)
      broken = "within the separation before toi";
  if (broken.empty()) return;
  INFO(to_text(query));
  INFO("known contact: " << known.contact << " by " << known.latest);
  INFO(oracle::to_text(options, result));
  FAIL_CHECK(broken);
}

// The separation is the exact distance at some time, rounded up: by then the pair is within it, however the
// rest moves.
TEST_CASE("a pair that comes exactly to the separation is found", "[property][oracle]") {
  const int count = oracle::fuzz(8);
  for (const scenes::Family& family : scenes::families())
    for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
      scenes::Random random = scenes::seeded(family, kind, oracle::fuzz_seed() + 3);
      for (int i = 0; i < count; ++i) {
        const Query query = family.make(kind, random);
        Options options;
        options.norm = scenes::coin(random) ? Norm::maximum : Norm::euclidean;
        options.relative_tolerance = scenes::power_of_ten(random, -12, -2);
        options.narrow_phase =
            scenes::integer(random, 0, 3) ? NarrowPhaseMethod::automatic : NarrowPhaseMethod::inclusion;
        const std::int64_t budgets[] = {1, 10, 1000, 1000000};
        options.max_checks = budgets[scenes::integer(random, 0, 3)];
        if (options.narrow_phase == NarrowPhaseMethod::inclusion)
          options.max_checks = std::min<std::int64_t>(options.max_checks, 10000);
        const double t = scenes::unit(random);
        const double d = oracle::distance(query, t, options.norm).hi;
        if (!(d <= 0x1p1020)) continue;
        INFO(family.name);
        const bool judge_zero = std::string(family.name) != "mixed_magnitudes";  // see test_never_misses.cpp
        options.min_separation = d;
        check(query, options, {true, t}, judge_zero);
        options.min_separation = std::nextafter(d, 0);
        check(query, options, {}, judge_zero);
        options.min_separation = d * scenes::unit(random);
        check(query, options, {}, judge_zero);
      }
    }
  SUCCEED();
}

TEST_CASE("a start apart in the maximum norm gets a step, whatever the budget", "[property][oracle]") {
  int zero = 0, total = 0;
  for (const scenes::Family& family : scenes::families())
    for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
      scenes::Random random = scenes::seeded(family, kind, oracle::fuzz_seed() + 4);
      for (int i = 0; i < oracle::fuzz(4); ++i) {
        const Query query = family.make(kind, random);
        Options options;
        options.norm = Norm::maximum;
        options.min_separation = oracle::distance(query, scenes::unit(random), options.norm).hi;
        options.max_checks = scenes::coin(random) ? 10 : 1000;
        if (!(options.min_separation <= 0x1p1020)) continue;
        ++total, zero += oracle::silent_zero(query, options, scenes::ccd(query, options));
      }
    }
  CAPTURE(total);
  CHECK(zero == 0);
}

namespace {

// A large triangle through the origin with normal (1, 1, 1), and a vertex that moves along the normal: its
// distance to the plane goes from `from` to `to`, in `norm`.
Query oblique(double from, double to, Norm norm) {
  const double per_unit = norm == Norm::maximum ? 1 : 1 / std::sqrt(3.0);
  Query query{PairKind::vertex_face, {{{}, {2, -1, -1}, {-1, 2, -1}, {-1, -1, 2}}}, {}};
  query.t1 = query.t0;
  query.t0[0].fill(from * per_unit);
  query.t1[0].fill(to * per_unit);
  return query;
}

QueryResult with_separation(const Query& query, Norm norm) {
  Options options;
  options.min_separation = 0.01;
  options.norm = norm;
  options.tolerance = 1e-8;
  return scenes::ccd(query, options);
}

}  // namespace

// A search that tests a box in the maximum norm against a distance in the Euclidean one sees the first two as
// contact at once, and then halves the separation or returns zero for ever.
TEST_CASE("an oblique approach keeps the separation, a start within it is told by direction",
          "[unit][oracle]") {
  for (Norm norm : {Norm::euclidean, Norm::maximum}) {
    const Query to_below = oblique(0.011, 0.009, norm), through = oblique(0.012, 0, norm);
    for (const auto& [query, exact] : {std::pair(to_below, 0.5), std::pair(through, 1.0 / 6)}) {
      const QueryResult result = with_separation(query, norm);
      CHECK(result.outcome == PairOutcome::contact);
      CHECK(result.toi <= exact + 1e-12);
      CHECK(result.toi >= exact - 1e-4);
      CHECK(oracle::compare_distance(query, result.toi, 0.01, norm) >= 0);
    }
    CHECK(with_separation(oblique(0.011, 0.0101, norm), norm).outcome == PairOutcome::free);
    const QueryResult apart = with_separation(oblique(0.009, 0.011, norm), norm);
    CHECK(apart.outcome == PairOutcome::initial_separating);
    const QueryResult pressing = with_separation(oblique(0.009, 0.005, norm), norm);
    CHECK(pressing.outcome == PairOutcome::initial_contact);
    CHECK(pressing.toi == 0);
  }
  const Query at_once = oblique(0.009, 0.0091, Norm::euclidean);  // 0.009 / sqrt 3 in the maximum norm
  CHECK(with_separation(at_once, Norm::maximum).collides());
}

TEST_CASE("a separation larger than the scene is contact at once", "[unit][oracle]") {
  for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge})
    for (double d : {100.0, 1e100, 0x1p1020}) {
      scenes::Random random(3);
      const scenes::Family& family = scenes::families().front();
      Options options;
      options.min_separation = d;
      for (int i = 0; i < 10; ++i) {
        const Query query = family.make(kind, random);
        const QueryResult result = scenes::ccd(query, options);
        const bool initial = result.outcome == PairOutcome::initial_contact ||
                             result.outcome == PairOutcome::initial_separating;
        CHECK(initial);
        CHECK(result.toi == 0);
      }
    }
}
