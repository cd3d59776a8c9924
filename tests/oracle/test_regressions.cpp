// Queries that other implementations get wrong, each with its exact answer.
#include "tests/catch.hpp"
#include "tests/oracle/promises.hpp"

using namespace onset;
using scenes::Query;

static void check_all_tolerances(const Query& query, double exact_toi) {
  const oracle::Truth truth = oracle::exact_ccd(query);
  REQUIRE(truth.collides);
  CHECK(truth.toi_lo == exact_toi);
  for (double tolerance : {1e-2, 1e-3, 1e-6, 1e-9, 1e-12}) {
    Options options;
    options.tolerance = tolerance;
    const QueryResult result = scenes::ccd(query, options);
    INFO(oracle::to_text(options, result));
    CHECK(oracle::broken_promise(query, options, result, oracle::known(truth)) == "");
    CHECK(oracle::wrong_report(query, options, result) == "");
  }
}

// A filter with min(max |x|, 1) where the proof needs max(max |x|, 1) loses these.
TEST_CASE("a vertex grazes a corner at coordinates of about a thousand", "[unit][oracle]") {
  const Point f0{0x1.96202fd3d7a46p+7, 0x1.37e7ed174a403p+8, 0x1.7d8e3b0de3c5fp+8},
      f1{0x1.2f1017e9ebd23p+8, 0x1.91e7ed174a403p+8, 0x1.7d8e3b0de3c5fp+8},
      f2{0x1.111017e9ebd23p+8, 0x1.9be7ed174a403p+8, 0x1.7d8e3b0de3c5fp+8};
  const Query query{PairKind::vertex_face,
                    {{{-0x1.0f2a5e5d5fb2fp+9, 0x1.d873edba5407fp+9, 0x1.ebe65d25f6e63p+9}, f0, f1, f2}},
                    {{{0x1.da3a76474b852p+9, -0x1.41180146138f8p+8, -0x1.b96088604c810p+7}, f0, f1, f2}}};
  check_all_tolerances(query, 0.5);
}

TEST_CASE("touching at t = 1 in millimetres, coordinates with one decimal", "[unit][oracle]") {
  check_all_tolerances(
      {PairKind::vertex_face,
       {{{962.5, -151.9, 445.3}, {-880.4, -888.6, -847.4}, {353.3, -700.0, -962.2}, {-18.6, -501.4, -102.1}}},
       {{{-41.5, -79.8, 100.3}, {-41.5, -79.8, 100.3}, {-754.7, 58.4, -303.4}, {-181.2, 974.3, -569.5}}}},
      1);
  check_all_tolerances(
      {PairKind::edge_edge,
       {{{-634.5, 186.9, 594.2}, {-509.4, 482.2, 317.2}, {-230.9, -890.6, -861.4}, {-941.1, 55.2, -423.5}}},
       {{{-31.6, -75.2, 100.3}, {-270.4, 464.2, 890.8}, {-31.6, -75.2, 100.3}, {16.9, -362.7, -286.8}}}},
      1);
}

TEST_CASE("examples of Wang et al. 2021, appendix B and C, by the library", "[unit][oracle]") {
  check_all_tolerances({PairKind::vertex_face,
                        {{{0.1, 0.1, 0.1}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}},
                        {{{0.1, 0.1, 0.1}, {0, 0, 0}, {0, 1, 0}, {1, 0, 0}}}},
                       0x1.cccccccccccccp-1);
  check_all_tolerances({PairKind::vertex_face,
                        {{{1, 0.5, 1}, {0, 0.57, 1}, {1, 0.57, 1}, {1, 1.57, 1}}},
                        {{{1, 0.5, 1}, {0, 0.28, 1}, {1, 0.28, 1}, {1, 1.28, 1}}}},
                       0x1.ee58469ee5842p-3);
  const Query inflection{PairKind::vertex_face,
                         {{{1, 1, 0}, {0, 0, 5}, {2, 0, 2}, {0, 1, 0}}},
                         {{{1, 1, 0}, {0, 0, -1}, {0, 0, -2}, {0, 7, 0}}}};
  CHECK(scenes::ccd(inflection).outcome == Outcome::free);
}

// Seconds a query elsewhere: parallel edges that slide along each other, a vertex inside its face's plane,
// edges that meet along a line. The checks are bounded, and the answers right.
TEST_CASE("sliding and coplanar pairs are decided within a few thousand checks", "[property][oracle]") {
  int queries = 0, budget = 0;
  for (const scenes::Family& family : scenes::families()) {
    const std::string name = family.name;
    if (name != "sliding" && name != "coplanar" && name != "parallel_meeting" && name != "resting") continue;
    for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
      scenes::Random random = scenes::seeded(family, kind, oracle::fuzz_seed() + 5);
      for (int i = 0; i < oracle::fuzz(40); ++i) {
        const Query query = family.make(kind, random);
        Options options;
        options.max_checks = 5000;
        const QueryResult result = scenes::ccd(query, options);
        INFO(family.name << " " << to_text(query) << " " << oracle::to_text(options, result));
        CHECK(oracle::broken_promise(query, options, result, oracle::known(oracle::exact_ccd(query))) == "");
        ++queries, budget += result.outcome == Outcome::budget;
      }
    }
  }
  CAPTURE(queries, budget);
  CHECK(budget <= queries / 20);
}
