// A second opinion on contacts that shares nothing with the first but the rational numbers: walk along the
// distance. If the pair is d apart at t and no difference of corners moves faster than v, it is apart until t
#include <algorithm>
// + d / v.
#include "tests/catch.hpp"
#include "tests/oracle/promises.hpp"
#include "tests/oracle/walk.hpp"
#include "tests/scenes/families.hpp"

using namespace onset;
using scenes::Query;

TEST_CASE("walking along the distance confirms contacts and misses", "[property][oracle]") {
  int misses = 0, proved_misses = 0, hits = 0, zero_at_toi = 0, close_before = 0;
  for (const scenes::Family& family : scenes::families())
    for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
      scenes::Random random = scenes::seeded(family, kind, oracle::fuzz_seed() + 20);
      for (int i = 0; i < std::max(4, oracle::fuzz(4)); ++i) {
        const Query query = family.make(kind, random);
        const oracle::Truth truth = oracle::exact_ccd(query);
        INFO(family.name << " " << to_text(query));
        const oracle::Walk w = oracle::walk(query, 0, truth.collides ? truth.toi_lo : 1, 200);
        if (!truth.collides) {
          ++misses, proved_misses += w.finished;
          continue;
        }
        ++hits;
        CHECK_FALSE(w.finished);
        CHECK(w.apart_until <= truth.toi_hi);
        close_before += w.apart_until >= 0.999 * truth.toi_lo;
        if (truth.toi_lo == truth.toi_hi) {
          CHECK(oracle::compare_distance(query, truth.toi_lo, 0) == 0);
          ++zero_at_toi;
        } else {  // the contact inside the bracket leaves no room for more than this at its ends
          const double reach =
              oracle::relative_speed(query) * (truth.toi_hi - truth.toi_lo) * (1 + 0x1p-40) + 0x1p-1074;
          CHECK(oracle::compare_distance(query, truth.toi_lo, reach) <= 0);
          CHECK(oracle::compare_distance(query, truth.toi_hi, reach) <= 0);
        }
      }
    }
  CAPTURE(misses, proved_misses, hits, zero_at_toi, close_before);
  CHECK(proved_misses > 0.7 * misses);
  CHECK(close_before > 0.7 * hits);
  CHECK(zero_at_toi > 0.3 * hits);
}
