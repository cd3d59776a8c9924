// The first time within a distance: against exact distances at that time and before, and answers by hand.
#include "tests/catch.hpp"
#include "tests/oracle/all_families.hpp"
#include "tests/oracle/promises.hpp"
#include "tests/oracle/quick.hpp"
#include "tests/oracle/walk.hpp"
#include "tests/oracle/within.hpp"

using namespace onset;
using scenes::Query;

namespace {

// Within d at the latest at toi_hi, beyond d at and before toi_lo, or for all time.
void check_first_time(const Query& query, double d, Norm norm, scenes::Random& random) {
  const oracle::Truth truth = oracle::exact_within(query, d, norm);
  INFO("d " << d << " norm " << int(norm) << " -> " << truth.toi_lo << " " << truth.toi_hi);
  if (truth.collides) {
    CHECK(truth.toi_lo <= truth.toi_hi);
    CHECK(std::nextafter(truth.toi_lo, 2) >= truth.toi_hi);
    CHECK(oracle::compare_distance(query, truth.toi_hi, d, norm) <= 0);
    if (truth.toi_lo < truth.toi_hi) CHECK(oracle::compare_distance(query, truth.toi_lo, d, norm) > 0);
  }
  const double until = truth.collides ? truth.toi_lo : 1;
  for (double part : {0.0, scenes::unit(random), 0.999, 1 - 0x1p-30})
    if (part * until < truth.toi_lo) CHECK(oracle::compare_distance(query, part * until, d, norm) > 0);
}

}  // namespace

TEST_CASE("the first time within a distance is the first, in both norms", "[property][oracle]") {
  for (Norm norm : {Norm::euclidean, Norm::maximum})
    oracle::for_all_families(oracle::fuzz(norm == Norm::euclidean ? 3 : 1), 61,
                             [&](const scenes::Family&, const Query& query, scenes::Random& random) {
                               const double size = oracle::extent(query);
                               if (!(size > 0x1p-900 && size < 0x1p900)) return;
                               const double at_some_time =
                                   oracle::distance(query, scenes::unit(random), norm).hi;
                               for (double d : {size * scenes::power_of_ten(random, -6, -1), at_some_time})
                                 check_first_time(query, d, norm, random);
                             });
}

TEST_CASE("times within a distance that are known by hand", "[unit][oracle]") {
  const std::array<Point, 3> f{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};
  const auto moving = [&](Point from, Point to) {
    return Query{PairKind::vertex_face, {from, f[0], f[1], f[2]}, {to, f[0], f[1], f[2]}};
  };
  const auto first = [](const Query& q, double d, Norm norm) {
    return oracle::exact_within(q, d, norm).toi_lo;
  };
  for (Norm norm : {Norm::euclidean, Norm::maximum}) {
    CHECK(first(moving({1, 1, 4}, {1, 1, 0}), 1, norm) == 0.75);   // above the inside
    CHECK(first(moving({1, -4, 0}, {1, 0, 0}), 1, norm) == 0.75);  // beside a side
    CHECK(first(moving({-4, 0, 0}, {0, 0, 0}), 1, norm) == 0.75);  // in line with a corner
    CHECK(first(moving({1, 1, 4}, {1, 1, 1}), 1, norm) == 1);      // at the end
    CHECK(first(moving({1, 1, 4}, {1, 1, 1.5}), 1, norm) == INFINITY);
    CHECK(first(moving({1, 1, 1}, {1, 1, 4}), 1, norm) == 0);
    CHECK(first(moving({8, -1, 0}, {0, -1, 0}), 1, norm) == (norm == Norm::euclidean ? 0.5 : 0.375));
  }
  CHECK(first(moving({-3, -4, 0}, {0, 0, 0}), 1, Norm::euclidean) == std::nextafter(0.8, 0));
  CHECK(first(moving({-3, -4, 0}, {0, 0, 0}), 1, Norm::maximum) == 0.75);
}

TEST_CASE("what is surely apart is so, also after a step and its rounding", "[property][oracle]") {
  int sure = 0, total = 0;
  oracle::for_all_families(
      oracle::fuzz(20), 62, [&](const scenes::Family&, const Query& query, scenes::Random& random) {
        const double until = scenes::unit(random);
        const double moved =
            scenes::coin(random) ? 0 : oracle::extent(query) * scenes::power_of_ten(random, -12, -2);
        double largest = 0;  // coordinate: what rounding `then` refers to
        for (const auto* points : {&query.t0, &query.t1})
          for (const Point& p : *points)
            largest = std::max({largest, std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
        ++total;
        if (!oracle::surely_apart(query, until, moved)) return;
        ++sure;
        const oracle::Truth truth = oracle::exact_ccd(query);
        CHECK((!truth.collides || truth.toi_hi > until));
        Query then = query;
        for (std::size_t i = 0; i < 4; ++i) {
          then.t0[i] = scenes::lerp(query.t0[i], query.t1[i], until);
          then.t1[i] = scenes::plus(then.t0[i], scenes::point(random, moved / 2));
        }
        if (moved > 0x1p-48 * largest) CHECK_FALSE(oracle::exact_ccd(then).collides);
      });
  CHECK(4 * sure > total);
}
