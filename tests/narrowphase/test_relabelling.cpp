// Edges exchanged, their ends exchanged, the face's vertices in another order: the same pair, so the same
// answer up to the tolerance. Bits of toi may differ.
#include "tests/catch.hpp"
#include "tests/fuzz.hpp"
#include "tests/narrowphase/samples.hpp"
#include "tests/narrowphase/separation.hpp"
#include "tests/narrowphase/symmetries.hpp"

using namespace onset;
using namespace onset::tests;
using scenes::Query;
using scenes::Random;

namespace {

bool initial(const QueryResult& r) {
  return r.outcome == PairOutcome::initial_contact || r.outcome == PairOutcome::initial_separating;
}

// What the two answers say about the same motion cannot both hold. Both are conservative and say how far
// beyond the separation they reported; the promises bound that by the tolerance.
std::string contradiction(const Query& query, const Options& o, const QueryResult& a, const QueryResult& b) {
  if (a.outcome == PairOutcome::max_checks || b.outcome == PairOutcome::max_checks) return {};
  const double floor = 2e-14 * extent(query);
  if (initial(a) != initial(b) && oracle::compare_distance(query, 0, o.min_separation + floor, o.norm) > 0)
    return "only one starts in contact";
  if (a.outcome != PairOutcome::contact || b.outcome != PairOutcome::contact) return {};
  const double early = std::min(a.toi, b.toi), late = std::max(a.toi, b.toi);
  if (early == late) return {};
  const double tolerance = std::max(a.tolerance, b.tolerance) * (1 + 0x1p-40) + floor + 0x1p-1070;
  if (oracle::compare_distance(query, early, (o.min_separation + tolerance) * (1 + 0x1p-50), o.norm) > 0)
    return "the earlier time is too early";
  return {};
}

}  // namespace

TEST_CASE("the same pair said otherwise gets the same answer up to the tolerance",
          "[property][equivariance]") {
  int queries = 0, same_outcome = 0;
  for_each_query(
      all_sources(), fuzz(4), 51, [&](const std::string& source, const Query& query, Random& random) {
        if (!(extent(query) < 0x1p900)) return;
        Options o;
        o.relative_tolerance = scenes::power_of_ten(random, -14, -2);
        const QueryResult base = ccd(query, o);
        for (const Query& other : relabelled(query)) {
          const QueryResult r = ccd(other, o);
          std::string broken = broken_promise(other, o, r);
          if (broken.empty()) broken = contradiction(query, o, base, r);
          if (!broken.empty())
            FAIL_CHECK(source << ": " << broken << "\n  " << to_text(query) << "\n  " << to_text(other)
                              << "\n  " << oracle::to_text(o, base) << "\n  " << oracle::to_text(o, r));
          ++queries, same_outcome += r.outcome == base.outcome;
        }
      });
  CAPTURE(queries, same_outcome);
  CHECK(same_outcome > 0.98 * queries);
}

// Where no tie and no tolerance is in play, the outcome itself is the same.
TEST_CASE("the same pair said otherwise is free or not alike where the gap is clear",
          "[property][equivariance]") {
  for_each_query(tied_sources(), fuzz(20), 52, [&](const std::string& source, const Query& query, Random&) {
    const Options o;
    const bool collides = oracle::exact_ccd(query).collides;
    const double closest = rough_distance(query, rough_closest_time(query, Norm::euclidean), Norm::euclidean);
    if (!collides && closest < 1e-3 * extent(query)) return;
    for (const Query& other : relabelled(query))
      if (ccd(other, o).collides() != collides) FAIL_CHECK(source << "\n  " << to_text(other));
  });
}
