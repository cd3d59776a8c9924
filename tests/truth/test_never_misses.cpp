// No contact is missed and no toi is late, for any family of queries, tolerance, budget or method.
// ONSET_FUZZ=100 for a long run, ONSET_SEED=n for other queries.
#include "tests/catch.hpp"
#include "tests/oracle/promises.hpp"
#include "tests/oracle/walk.hpp"

using namespace onset;
using scenes::Query;

constexpr double kTolerances[] = {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-14};
constexpr std::int64_t kBudgets[] = {1, 10, 100, 1'000'000};
constexpr std::int64_t kInclusionBudget = 5000;  // dearer checks

// Sizes 1e-30 to 1e30 in one pair: a start apart by less than about 1e-10 of the largest is taken for
// touching.
static bool beyond_doubles(const scenes::Family& family) {
  return std::string(family.name) == "mixed_magnitudes";
}

static void fail(const scenes::Family& family, const Query& query, const oracle::Truth& truth,
                 const Options& options, const QueryResult& result, const std::string& why) {
  INFO(family.name << " " << to_text(query));
  INFO("exact: " << truth.collides << " [" << truth.toi_lo << ", " << truth.toi_hi << "]");
  INFO(oracle::to_text(options, result));
  FAIL_CHECK(why);
}

template <class F>  // f(options)
static void for_all_options(scenes::Random& random, F&& f) {
  Options options;
  for (double tolerance : kTolerances)
    for (std::int64_t budget : kBudgets) {
      options.relative_tolerance = tolerance;
      options.max_checks = budget;
      options.instruction_set = scenes::coin(random) ? InstructionSet::scalar : InstructionSet::automatic;
      options.narrow_phase =
          scenes::integer(random, 0, 3) ? NarrowPhaseMethod::automatic : NarrowPhaseMethod::inclusion;
      if (options.narrow_phase == NarrowPhaseMethod::inclusion)
        options.max_checks = std::min(budget, kInclusionBudget);
      f(options);
    }
}

TEST_CASE("no contact of any family is missed, at any tolerance and budget", "[property][oracle]") {
  const int count = oracle::fuzz(16);
  for (const scenes::Family& family : scenes::families())
    for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge})
      DYNAMIC_SECTION(family.name << " " << scenes::name(kind)) {
        scenes::Random random = scenes::seeded(family, kind, oracle::fuzz_seed()), choice(7);
        for (int i = 0; i < count; ++i) {
          const Query query = family.make(kind, random);
          const oracle::Truth truth = oracle::exact_ccd(query);
          for_all_options(choice, [&](const Options& options) {
            const QueryResult result = scenes::ccd(query, options);
            std::string broken = oracle::broken_promise(query, options, result, oracle::known(truth));
            if (!beyond_doubles(family) && oracle::silent_zero(query, options, result))
              broken = "a step of zero from a start that is apart";
            if (!broken.empty()) fail(family, query, truth, options, result, broken);
          });
        }
        SUCCEED();
      }
}

TEST_CASE("outcome and tolerance are as reported", "[property][oracle]") {
  const int count = oracle::fuzz(4);
  for (const scenes::Family& family : scenes::families())
    for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge})
      DYNAMIC_SECTION(family.name << " " << scenes::name(kind)) {
        scenes::Random random = scenes::seeded(family, kind, oracle::fuzz_seed() + 1), choice(8);
        for (int i = 0; i < count; ++i) {
          const Query query = family.make(kind, random);
          for_all_options(choice, [&](const Options& options) {
            const QueryResult result = scenes::ccd(query, options);
            const std::string wrong = oracle::wrong_report(query, options, result);
            if (!wrong.empty()) fail(family, query, oracle::exact_ccd(query), options, result, wrong);
          });
        }
        SUCCEED();
      }
}

TEST_CASE("no check beyond the budget, and the tolerance as reported where it is spent",
          "[property][oracle]") {
  int over = 0, wrong = 0;
  for (const scenes::Family& family : scenes::families())
    for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
      scenes::Random random = scenes::seeded(family, kind, oracle::fuzz_seed() + 1), choice(8);
      const Query query = family.make(kind, random);
      for_all_options(choice, [&](const Options& options) {
        const QueryResult result = scenes::ccd(query, options);
        over += result.checks > options.max_checks;
        if (result.outcome == PairOutcome::max_checks)
          wrong += oracle::tolerance_understated(query, options, result);
      });
    }
  CHECK(over == 0);
  CHECK(wrong == 0);
}

// The other side of "never misses": an answer that is always "contact" is no answer.
TEST_CASE("pairs that stay farther apart than the tolerance are free", "[property][oracle]") {
  const int count = oracle::fuzz(6);
  int proved = 0, total = 0;
  for (const scenes::Family& family : scenes::families())
    for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
      scenes::Random random = scenes::seeded(family, kind, oracle::fuzz_seed() + 2);
      for (int i = 0; i < count; ++i) {
        const Query query = family.make(kind, random);
        Options options;
        options.relative_tolerance = 1e-6;
        ++total;
        const double gap = 1.01 * options.relative_tolerance * oracle::extent(query) + 0x1p-1060;
        if (!oracle::walk(query, gap, 1, 60).finished) continue;
        ++proved;
        const QueryResult result = scenes::ccd(query, options);
        if (result.collides()) fail(family, query, {}, options, result, "not a contact");
      }
    }
  CHECK(proved > total / 8);
}

// The bound of the rounding errors is what these stress: one short and a fifth of them is missed.
TEST_CASE("touching at exactly t = 1 at magnitudes 1e-12 to 1e12 is not missed", "[property][oracle]") {
  scenes::Random random(oracle::fuzz_seed());
  const Options options;
  for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge})
    for (int i = 0; i < oracle::fuzz(4000); ++i) {
      Query query;
      query.kind = kind;
      const double size = std::pow(10.0, scenes::integer(random, -12, 12));
      for (auto* points : {&query.t0, &query.t1})
        for (Point& p : *points) p = scenes::point(random, size);
      const int target = scenes::first_body(kind) + scenes::integer(random, 0, 1);
      query.t1[0] = query.t1[target];
      const QueryResult result = scenes::ccd(query, options);
      if (!result.collides() || result.toi == 0)
        FAIL_CHECK(to_text(query) << oracle::to_text(options, result));
    }
  SUCCEED();
}
