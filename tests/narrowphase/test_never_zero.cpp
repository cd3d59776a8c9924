// From a start that is apart the time is positive, whatever the budget and the tolerance.
#include "tests/catch.hpp"
#include "tests/fuzz.hpp"
#include "tests/narrowphase/samples.hpp"
#include "tests/narrowphase/separation.hpp"
#include "tests/queries/random_query.hpp"

using namespace onset;
using namespace onset::tests;
using scenes::Query;
using scenes::Random;

namespace {

constexpr double kTolerances[] = {1e3, 1e-2, 1e-6, 1e-10, 1e-14};
constexpr std::int64_t kBudgets[] = {1, 2, 10};

// Farther apart than d, by more than any double arithmetic on corners could overlook.
bool starts_apart(const Query& query, double d, Norm norm) {
  return oracle::compare_distance(query, 0, (d + 2e-14 * extent(query)) * (1 + 0x1p-46) + 0x1p-1060, norm) >
         0;
}

void check(const std::string& source, const Query& query, double d, Norm norm, NarrowPhaseMethod method) {
  for (double tolerance : kTolerances)
    for (std::int64_t budget : kBudgets) {
      Options o;
      o.relative_tolerance = tolerance;
      o.max_checks = budget;
      o.min_separation = d;
      o.norm = norm;
      o.narrow_phase = method;
      const QueryResult r = ccd(query, o);
      if (!(r.toi > 0) || r.outcome == PairOutcome::initial_contact ||
          r.outcome == PairOutcome::initial_separating)
        FAIL_CHECK(source << "\n  " << to_text(query) << "\n  " << oracle::to_text(o, r));
    }
}

// Two primitives that nearly touch at t = 0, at a corner, on an edge or inside, and move at random.
Query nearly_touching(PairKind kind, Random& random) {
  Query query = scenes::random_query(kind, random);
  const double u = scenes::integer(random, 0, 2) ? scenes::uniform(random, 0.1, 0.5) : 0;
  const double v = scenes::integer(random, 0, 2) ? scenes::uniform(random, 0.1, 0.5) : 0;
  scenes::aim(query, 0, u, v);
  const Point gap = scenes::point(random, scenes::power_of_ten(random, -14, -8));
  for (int i = 0; i < scenes::first_body(kind); ++i) query.t0[i] = scenes::plus(query.t0[i], gap);
  return scenes::scaled(query, scenes::power_of_ten(random, -12, 12));
}

}  // namespace

TEST_CASE("a start that is apart is never answered by zero", "[property][oracle]") {
  int apart = 0;
  for_each_query(
      all_sources(), fuzz(8), 31, [&](const std::string& source, const Query& query, Random& random) {
        if (!(extent(query) < 0x1p900) || !starts_apart(query, 0, Norm::euclidean)) return;
        ++apart;
        check(source, query, 0, Norm::euclidean,
              scenes::integer(random, 0, 3) ? NarrowPhaseMethod::automatic : NarrowPhaseMethod::inclusion);
      });
  CHECK(apart > fuzz(300));
}

TEST_CASE("gaps of 1e-14 to 1e-8 are not answered by zero", "[property][oracle]") {
  int apart = 0;
  for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
    Random random(32);
    for (int i = 0; i < fuzz(1500); ++i) {
      const Query query = nearly_touching(kind, random);
      if (!starts_apart(query, 0, Norm::euclidean)) continue;
      ++apart;
      check("nearly touching", query, 0, Norm::euclidean, NarrowPhaseMethod::automatic);
    }
  }
  CHECK(apart > fuzz(1500));
}

TEST_CASE("a start farther apart than the separation is never answered by zero", "[property][oracle]") {
  for (Norm norm : {Norm::euclidean, Norm::maximum}) {
    INFO("norm " << int(norm));
    int apart = 0;
    for_each_query(
        all_sources(), fuzz(3), 33, [&](const std::string& source, const Query& query, Random& random) {
          if (!(extent(query) < 0x1p900 && extent(query) > 0x1p-900)) return;
          const double d = rough_distance(query, 0, norm) * (1 - scenes::power_of_ten(random, -13, -0.01));
          if (!(d > 0) || !starts_apart(query, d, norm)) return;
          ++apart;
          check(source, query, d, norm, NarrowPhaseMethod::automatic);
        });
    CHECK(apart > fuzz(100));
  }
}
