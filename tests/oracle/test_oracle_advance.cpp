// A second opinion on contacts that shares nothing with the first but the rational numbers: walk along the
// distance. If the pair is d apart at t and no difference of corners moves faster than v, it is apart until t
// + d / v.
#include "tests/catch.hpp"
#include "tests/oracle/oracle.hpp"
#include "tests/scenes/families.hpp"

using namespace onset;
using scenes::Query;

// An upper bound of the speed of any difference between a point of one primitive and a point of the other; 0:
// no motion.
static double speed(const Query& query) {
  double fastest = 0;
  const int first = scenes::first_body(query.kind);
  for (int i = 0; i < first; ++i)
    for (int j = first; j < 4; ++j) {
      double sum =
          0;  // |x|_1 >= |x|_2; each of the three subtractions and two additions errs by 2^-53 at most
      for (int k = 0; k < 3; ++k) {
        const double at_t0 = query.t0[i][k] - query.t0[j][k], at_t1 = query.t1[i][k] - query.t1[j][k];
        const double largest = std::max(std::abs(at_t0), std::abs(at_t1));
        sum += std::abs(at_t1 - at_t0) + largest * 0x1p-50 + 0x1p-1070;
      }
      fastest = std::max(fastest, sum * (1 + 0x1p-40));
    }
  return fastest;
}

struct Walk {
  double free_until = 0;  // certainly apart on [0, free_until)
  bool finished = false;  // ... and at 1
};
static Walk walk(const Query& query, double until, int steps) {
  const double v = speed(query);
  Walk w;
  while (steps-- > 0) {
    const double d = oracle::distance(query, w.free_until).lo;
    if (d == 0) return w;
    const double step = d / v * (1 - 0x1p-40), next = w.free_until + step;
    if (next > 1 && d / v < INFINITY) return {1, true};
    if (!(next > w.free_until) || w.free_until >= until) return w;
    w.free_until = std::nextafter(next, 0);
  }
  return w;
}

TEST_CASE("walking along the distance confirms contacts and misses", "[property][oracle]") {
  int misses = 0, proved_misses = 0, hits = 0, zero_at_toi = 0, close_before = 0;
  for (const scenes::Family& family : scenes::families())
    for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
      scenes::Random random = scenes::seeded(family, kind, 21);
      for (int i = 0; i < 4; ++i) {
        const Query query = family.make(kind, random);
        const oracle::Truth truth = oracle::exact_ccd(query);
        INFO(family.name << " " << to_text(query));
        const Walk w = walk(query, truth.collides ? truth.toi_lo : 1, 200);
        if (!truth.collides) {
          ++misses, proved_misses += w.finished;
          continue;
        }
        ++hits;
        CHECK_FALSE(w.finished);
        CHECK(w.free_until <= truth.toi_hi);
        close_before += w.free_until >= 0.999 * truth.toi_lo;
        if (truth.toi_lo == truth.toi_hi) {
          CHECK(oracle::compare_distance(query, truth.toi_lo, 0) == 0);
          ++zero_at_toi;
        } else {  // the contact inside the bracket leaves no room for more than this at its ends
          const double reach = speed(query) * (truth.toi_hi - truth.toi_lo) * (1 + 0x1p-40) + 0x1p-1074;
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
