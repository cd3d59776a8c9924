// The running error bound of the inclusion root finder: every corner of every box that halving reaches is
// within the box's bound of its exact value.
//
// The class under test has no header, so its source is included here, with everything it includes before it
// and its insides made visible.
#include <algorithm>
#include <cmath>
#include <queue>
#include <vector>

#include "narrowphase/corners.hpp"
#define find_first_inclusion find_first_inclusion_of_the_test
#include "narrowphase/inclusion.hpp"
#define private public
#include "narrowphase/inclusion.cpp"
#undef private

#include "tests/catch.hpp"
#include "tests/fuzz.hpp"
#include "tests/narrowphase/exact/exact_pair.hpp"
#include "tests/narrowphase/query_corners.hpp"
#include "tests/narrowphase/samples.hpp"
#include "tests/queries/random_query.hpp"

using namespace onset;
using namespace onset::tests;
using scenes::Query;
using scenes::Random;

namespace {

// A box with the exact values at its corners.
struct Tracked {
  Box box;
  RationalVector f[8];
};

double worst_ratio(const Tracked& t, int per_end) {
  double worst = 0;
  for (int k = 0; k < 2 * per_end; ++k)
    for (int a = 0; a < 3; ++a)
      worst = std::max(
          worst, static_cast<double>(abs(Rational(t.box.f[k][a]) - t.f[k][a]) / Rational(t.box.error[a])));
  return worst;
}

struct Halving {
  std::vector<std::pair<int, int>> edges;
  bool in_time;
};
std::vector<Halving> halvings(int per_end) {
  if (per_end == 4)
    return {{{{0, 4}, {1, 5}, {2, 6}, {3, 7}}, true},
            {{{0, 2}, {1, 3}, {4, 6}, {5, 7}}, false},
            {{{0, 1}, {2, 3}, {4, 5}, {6, 7}}, false}};
  return {{{{0, 3}, {1, 4}, {2, 5}}, true},
          {{{0, 1}, {3, 4}}, false},
          {{{1, 2}, {4, 5}}, false},
          {{{2, 0}, {5, 3}}, false}};
}

// One half of a box, and the exact values at its corners.
Tracked halved(const InclusionInput& input, const Tracked& t, const Halving& how, bool keep_upper) {
  Search search(input);
  const auto& e = how.edges;
  const auto ends = [&](int i) { return Search::Ends{e[std::size_t(i)].first, e[std::size_t(i)].second}; };
  if (e.size() == 2) search.halve(t.box, {ends(0), ends(1)}, how.in_time);
  if (e.size() == 3) search.halve(t.box, {ends(0), ends(1), ends(2)}, how.in_time);
  if (e.size() == 4) search.halve(t.box, {ends(0), ends(1), ends(2), ends(3)}, how.in_time);
  REQUIRE(search.boxes_.size() == 2);
  Tracked next = t;
  next.box = search.boxes_[std::size_t(keep_upper)];
  for (const auto& [from, to] : how.edges) {
    const RationalVector middle = oracle::scaled<Rational>(Rational(0.5), plus(t.f[from], t.f[to]));
    next.f[keep_upper ? from : to] = middle;
  }
  return next;
}

double largest_corner(const Tracked& t, int per_end) {
  double m = 0;
  for (int k = 0; k < 2 * per_end; ++k)
    for (double x : t.box.f[k]) m = std::max(m, std::fabs(x));
  return m;
}

}  // namespace

TEST_CASE("the running bound of halved corners holds", "[property][oracle]") {
  double largest = 0;
  for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
    Random random(97);
    for (int i = 0; i < std::max(150, fuzz(150)); ++i) {
      Query query = scenes::mixed_query(kind, random);
      if (scenes::coin(random))
        query = scenes::moved(query, scenes::point(random, scenes::power_of_ten(random, 0, 6)));
      const Corners corners = corners_of(query);
      // So large a separation keeps every box.
      const double begin = scenes::coin(random) ? 0 : scenes::unit(random);
      const InclusionInput input{corners, begin, 0x1p40, 1e-9, false, 1000};
      Search search(input);
      const ExactPair pair(query, corners.unit);
      Tracked t;
      t.box = search.push_root();
      for (int k = 0; k < corners.count; ++k)
        t.f[k] = pair.corner(k, begin), t.f[corners.count + k] = pair.c[1][k];
      largest = std::max(largest, worst_ratio(t, corners.count));
      const auto ways = halvings(corners.count);
      for (int depth = 0; depth < 60; ++depth) {
        const Halving& how = ways[std::size_t(scenes::integer(random, 0, int(ways.size()) - 1))];
        const Tracked lower = halved(input, t, how, false), upper = halved(input, t, how, true);
        const bool towards_zero = scenes::integer(random, 0, 3) > 0;
        const bool lower_is_smaller =
            largest_corner(lower, corners.count) < largest_corner(upper, corners.count);
        t = (towards_zero ? lower_is_smaller : scenes::coin(random)) ? lower : upper;
        largest = std::max(largest, worst_ratio(t, corners.count));
      }
    }
  }
  std::printf("%-58s largest error / bound %.3f\n", "inclusion: halved corners, running bound", largest);
  CHECK(largest <= 1);
  CHECK(largest > 0.2);
}

// The middles of time are rounded, and the corners are those of the exact middles.
TEST_CASE("a box's first time is not late where its middles are rounded", "[oracle][regression]") {
  const double a = 0x1p-49;
  struct {
    double t_begin, z0, z1;
  } cases[] = {{0x1.05e638e705612p-1, 0x1.e83a3c0c1612ap-1, -0x1.ae3190a24e6f1p-1}};
  Random random(98);
  for (int i = 0; i < fuzz(20000); ++i) {
    auto c = cases[0];
    if (i > 0)
      c = {0.5 + 0.05 * scenes::unit(random), 0.5 + 0.5 * scenes::unit(random),
           -0.5 - 0.5 * scenes::unit(random)};
    Query query{PairKind::vertex_face,
                {{{0, 0, c.z0}, {-a, -a, 0}, {a, -a, 0}, {0, a, 0}}},
                {{{0, 0, c.z1}, {-a, -a, 0}, {a, -a, 0}, {0, a, 0}}}};
    const Corners corners = corners_of(query);
    const Rational exact = Rational(c.z0) / (Rational(c.z0) - Rational(c.z1));
    if (exact <= Rational(c.t_begin)) continue;
    const InclusionResult r =
        find_first_inclusion_of_the_test({corners, c.t_begin, 0, 116 * 0x1p-53 * corners.rho});
    CAPTURE(i, c.t_begin, c.z0, c.z1, r.t);
    REQUIRE(r.end == InclusionResult::End::contact);
    REQUIRE(Rational(r.t) <= exact);
  }
}
