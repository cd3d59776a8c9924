// What storing a step's end does to a pair: answers by hand, and that the quick answer is the exact one.
#include "tests/catch.hpp"
#include "tests/oracle/oracle.hpp"
#include "tests/oracle/promises.hpp"
#include "tests/oracle/stored.hpp"
#include "tests/queries/random_query.hpp"

using namespace onset;
using oracle::Rounding;
using scenes::Query;

namespace {

// A vertex over a face at the level `floor`, from `from` to `to`.
Query falling(double floor, double from, double to) {
  const Point f0{-2, -2, floor}, f1{2, -2, floor}, f2{0, 2, floor};
  return {PairKind::vertex_face, {{{0, 0, from}, f0, f1, f2}}, {{{0, 0, to}, f0, f1, f2}}};
}

std::string broken(const Query& query, double s, double height) {
  std::array<Point, 4> end = query.t0;
  end[0][2] = height;
  return oracle::broken_on_the_way(query, s, end);
}

}  // namespace

TEST_CASE("a pair is followed on the exact way, as stored and in between", "[unit][oracle]") {
  const Query fall = falling(0, 3, -3);
  CHECK(broken(fall, 0.25, 1.5) == "");
  CHECK(broken(fall, 0.5, 0) == "touches on the exact way");
  CHECK(broken(fall, 0.75, -1.5) == "touches on the exact way");
  CHECK(broken(fall, std::nextafter(0.5, 0), 0) == "touches as stored");
  CHECK(broken(fall, std::nextafter(0.5, 0), -0x1p-60) == "is stored on the other side");
  CHECK(broken(fall, std::nextafter(0.5, 0), 0x1p-60) == "");
  Query beside = fall;  // a hair beside the face's side, which the stored vertex is not
  beside.t0[0][0] = beside.t1[0][0] = 0x1p-80;
  beside.t0[0][1] = beside.t1[0][1] = 2;
  CHECK(broken(beside, 0.75, -1.5) == "");
  CHECK(std::string(
            oracle::broken_on_the_way(beside, 0.75, oracle::stored(Rounding::product, beside, 0.75))) == "");
}

TEST_CASE("the three roundings are the double nearest but a few to the exact position",
          "[property][oracle]") {
  scenes::Random random(oracle::fuzz_seed() + 63);
  for (int i = 0; i < oracle::fuzz(2000); ++i) {
    const double offset = scenes::integer(random, 0, 3) ? scenes::power_of_ten(random, -9, 9) : 0;
    const double x0 = offset + scenes::uniform(random, -1, 1), x1 = offset + scenes::uniform(random, -1, 1);
    const double s = scenes::coin(random) ? scenes::unit(random) : scenes::power_of_ten(random, -12, 0);
    const oracle::Rational exact =
        oracle::Rational(x0) + oracle::Rational(s) * (oracle::Rational(x1) - oracle::Rational(x0));
    const double size = std::max(std::abs(x0), std::abs(x1));
    for (Rounding how : oracle::kRoundings)
      CHECK(abs(exact - oracle::Rational(oracle::stored(how, x0, x1, s))) <=
            oracle::Rational(0x1p-51 * size));
  }
}

TEST_CASE("the quick answer about a stored step is the exact one", "[property][oracle]") {
  int crossed = 0;
  for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
    scenes::Random random(oracle::fuzz_seed() + 64);
    for (int i = 0; i < oracle::fuzz(300); ++i) {
      const double offset = scenes::power_of_ten(random, 0, 9);
      const Query query = scenes::moved(scenes::interior_query(kind, random), {offset, -offset, offset});
      const oracle::Truth truth = oracle::exact_ccd(query);
      if (!truth.collides || truth.toi_lo == 0) continue;
      const double s = truth.toi_lo * (1 - scenes::power_of_ten(random, -17, -1));
      const auto end = oracle::stored(oracle::kRoundings[scenes::integer(random, 0, 2)], query, s);
      Query last{kind, query.t0, end};  // nearly the same way; the end is the same
      const bool crosses = oracle::exact_ccd(last).collides;
      const bool told = *oracle::broken_on_the_way(query, s, end) != 0;
      crossed += crosses;
      INFO(to_text(query) << " step " << s);
      if (offset < 2 && s < 0.99 * truth.toi_lo) CHECK_FALSE(told);
      const bool gap_closed = oracle::compare_distance_at_rest(kind, end, 0) == 0;
      if (gap_closed) CHECK(told);
      if (crosses) CHECK(told);
    }
  }
  CHECK(crossed > 0);
}
