// What Options::exactness promises about single queries, against the rational oracle.
#include "tests/catch.hpp"
#include "tests/narrowphase/exact/exact_query.hpp"
#include "tests/oracle/all_families.hpp"
#include "tests/oracle/promises.hpp"
#include "tests/oracle/walk.hpp"
#include "tests/queries/query_file.hpp"
#include "tests/scenes/data.hpp"

using namespace onset;
using scenes::Query;

namespace {

bool same(const QueryResult& x, const QueryResult& y) {
  return x.outcome == y.outcome && x.toi == y.toi && x.step_limit == y.step_limit &&
         x.tolerance == y.tolerance && x.certainty == y.certainty && x.toi_hi == y.toi_hi;
}

struct Count {
  int false_positives = 0, positives = 0;
};
Count count_hand_made(const std::string& folder, double tolerance, const Options& base) {
  Options options = base;
  options.relative_tolerance = tolerance;
  Count count;
  for (const scenes::QueryFile& file : scenes::query_files(folder))
    for (const scenes::LabelledQuery& labelled : scenes::read_queries(file.path, file.kind)) {
      const bool hit = scenes::ccd(labelled.query, options).collides();
      if (labelled.collides) CHECK(hit);
      count.positives += hit;
      count.false_positives += hit && !labelled.collides;
    }
  return count;
}

}  // namespace

TEST_CASE("exact: neither a miss nor a false positive, whatever the tolerance and budget",
          "[property][oracle]") {
  scenes::Random choice(9);
  oracle::for_all_families(
      oracle::fuzz(16), 41, [&](const scenes::Family&, const Query& query, scenes::Random&) {
        const oracle::Truth truth = oracle::exact_ccd(query);
        Options options;
        options.exactness = Exactness::exact;
        options.relative_tolerance = scenes::power_of_ten(choice, -14, -2);
        if (scenes::coin(choice)) options.max_checks = scenes::integer(choice, 1, 20);
        const QueryResult r = scenes::ccd(query, options);
        INFO(oracle::to_text(options, r) << " exact: " << truth.toi_lo << " " << truth.toi_hi);
        CHECK(r.collides() == truth.collides);
        if (!r.collides()) return;
        CHECK(r.outcome != PairOutcome::max_checks);
        CHECK(r.toi_hi == truth.toi_hi);
        CHECK(r.toi == truth.toi_lo);
        const bool at_start = truth.toi_hi == 0;
        CHECK((r.certainty == Certainty::touching_at_start) == at_start);
        CHECK(r.certainty != Certainty::within_tolerance);
      });
}

TEST_CASE("certify: what is called certain is real, and touches by toi_hi", "[property][oracle]") {
  int certain = 0, left = 0;
  oracle::for_all_families(
      oracle::fuzz(16), 42, [&](const scenes::Family&, const Query& query, scenes::Random&) {
        Options options;
        options.exactness = Exactness::certify;
        const QueryResult r = scenes::ccd(query, options);
        const oracle::Truth truth = oracle::exact_ccd(query);
        INFO(oracle::to_text(options, r) << " exact: " << truth.toi_lo << " " << truth.toi_hi);
        if (truth.collides) CHECK(r.collides());
        if (r.collides() && truth.collides) CHECK(r.toi <= truth.toi_lo);
        if (!r.collides() || r.certainty == Certainty::within_tolerance) {
          left += r.collides();
          return;
        }
        ++certain;
        CHECK(truth.collides);
        CHECK(truth.toi_hi <= r.toi_hi);
        if (r.certainty == Certainty::touching_at_start) CHECK(truth.toi_hi == 0);
      });
  CHECK(certain > 2 * left);
}

TEST_CASE("certain with a separation: they do come as close", "[property][oracle]") {
  int certain = 0;
  oracle::for_all_families(
      oracle::fuzz(8), 43, [&](const scenes::Family&, const Query& query, scenes::Random&) {
        Options options;
        options.exactness = Exactness::exact;
        options.min_separation = 0.01 * oracle::extent(query);
        if (!(options.min_separation > 0x1p-1000)) return;
        const QueryResult r = scenes::ccd(query, options);
        if (!r.collides() || r.certainty == Certainty::within_tolerance) return;
        ++certain;
        bool close = false;
        for (int i = 0; i <= 200 && !close; ++i)
          close = oracle::compare_distance(query, r.toi + (1 - r.toi) * i / 200, options.min_separation) <= 0;
        for (double ahead = 0x1p-20; ahead <= 1 && !close; ahead *= 2)
          close = oracle::compare_distance(query, r.toi + (1 - r.toi) * ahead, options.min_separation) <= 0;
        INFO(oracle::to_text(options, r));
        CHECK(close);
      });
  CHECK(certain > 100);
}

TEST_CASE("certainty: the same bytes from both kernels", "[determinism]") {
  oracle::for_all_families(oracle::fuzz(16), 44,
                           [&](const scenes::Family&, const Query& query, scenes::Random&) {
                             for (Exactness level : {Exactness::certify, Exactness::exact}) {
                               Options options;
                               options.exactness = level;
                               options.instruction_set = InstructionSet::scalar;
                               const QueryResult scalar = scenes::ccd(query, options);
                               options.instruction_set = InstructionSet::automatic;
                               CHECK(same(scalar, scenes::ccd(query, options)));
                             }
                           });
}

TEST_CASE("false positives of the hand-made queries", "[oracle][data]") {
  const std::string folder = scenes::data_folder("false positives of the hand-made queries");
  if (folder.empty()) return;
  Options options;
  CHECK(count_hand_made(folder, 1e-6, options).false_positives <= 127);
  CHECK(count_hand_made(folder, 1e-12, options).false_positives <= 31);
  options.exactness = Exactness::exact;
  for (double tolerance : {1e-3, 1e-6, 1e-8, 1e-10, 1e-12}) {
    const Count count = count_hand_made(folder, tolerance, options);
    CHECK(count.false_positives == 0);
    CHECK(count.positives > 100);
  }
}
