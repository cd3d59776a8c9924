// The oracle decides what is true for the whole project, so it is checked against everything that is known
// without it: answers worked out by hand, contacts by construction, symmetry, a second number type, and
// distances whose minimality is proved by a separating plane.
#include "tests/catch.hpp"
#include "tests/oracle/all_families.hpp"
#include "tests/oracle/contact.hpp"
#include "tests/oracle/distance.hpp"
#include "tests/oracle/oracle.hpp"
#include "tests/oracle/promises.hpp"
#include "tests/scenes/families.hpp"

using namespace onset;
using oracle::operator-;
using oracle::Rational;
using oracle::Truth;
using scenes::Query;

constexpr PairKind kVertexFace = PairKind::vertex_face, kEdgeEdge = PairKind::edge_edge;

static void check_time(const Query& query, double lo, double hi) {
  const Truth truth = oracle::exact_ccd(query);
  INFO(to_text(query));
  CHECK(truth.collides);
  CHECK(truth.toi_lo == lo);
  CHECK(truth.toi_hi == hi);
}
static void check_free(const Query& query) {
  INFO(to_text(query));
  CHECK_FALSE(oracle::exact_ccd(query).collides);
}

// f(query) for `count` queries of every family and kind.
TEST_CASE("examples of Wang et al. 2021, appendix B and C", "[unit][oracle]") {
  const Query not_handled_by_brochu{kVertexFace,
                                    {{{0.1, 0.1, 0.1}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}},
                                    {{{0.1, 0.1, 0.1}, {0, 0, 0}, {0, 1, 0}, {1, 0, 0}}}};
  check_time(not_handled_by_brochu, 0x1.cccccccccccccp-1, 0x1.ccccccccccccdp-1);
  check_free({kVertexFace,
              {{{1, 1, 0}, {0, 0, 5}, {2, 0, 2}, {0, 1, 0}}},
              {{{1, 1, 0}, {0, 0, -1}, {0, 0, -2}, {0, 7, 0}}}});
  check_time({kVertexFace,
              {{{1, 0.5, 1}, {0, 0.57, 1}, {1, 0.57, 1}, {1, 1.57, 1}}},
              {{{1, 0.5, 1}, {0, 0.28, 1}, {1, 0.28, 1}, {1, 1.28, 1}}}},
             0x1.ee58469ee5842p-3, 0x1.ee58469ee5843p-3);
}

TEST_CASE("a vertex through a face, over its sides, and past them", "[unit][oracle]") {
  const auto dropped = [](double x, double y, double z0, double z1) {
    return Query{kVertexFace,
                 {{{x, y, z0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
                 {{{x, y, z1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}};
  };
  check_time(dropped(0.25, 0.25, 1, -1), 0.5, 0.5);
  check_time(dropped(0.25, 0.25, 1, -3), 0.25, 0.25);
  check_time(dropped(0.25, 0.25, 1, -2), oracle::round_down<Rational>(Rational(1) / 3),
             oracle::round_up<Rational>(Rational(1) / 3));
  check_time(dropped(0, 0, 1, -1), 0.5, 0.5);
  check_time(dropped(0.5, 0.5, 1, -1), 0.5, 0.5);
  check_time(dropped(0.25, 0.25, 1, 0), 1, 1);
  check_time(dropped(0.25, 0.25, 0, 1), 0, 0);
  check_time(dropped(0.25, 0.25, 0, 0), 0, 0);
  check_free(dropped(0.5, std::nextafter(0.5, 1), 1, -1));
  check_free(dropped(-0x1p-1074, 0.5, 1, -1));
  check_free(dropped(0.25, 0.25, 1, 0x1p-1074));
  check_free(dropped(0.25, 0.25, -0x1p-1074, -1));
}

TEST_CASE("edges that cross, end on each other, and stay parallel", "[unit][oracle]") {
  const auto lowered = [](Point b0, Point b1, double z0, double z1) {
    Query query{kEdgeEdge, {{{0, 0, 0}, {1, 0, 0}, b0, b1}}, {{{0, 0, 0}, {1, 0, 0}, b0, b1}}};
    for (int i : {2, 3}) query.t0[i][2] += z0, query.t1[i][2] += z1;
    return query;
  };
  check_time(lowered({0.5, -1, 0}, {0.5, 1, 0}, 1, -1), 0.5, 0.5);
  check_time(lowered({1, 0, 0}, {1, 1, 0}, 1, -1), 0.5, 0.5);        // corner on corner
  check_time(lowered({0.25, 0, 0}, {0.75, 0, 0}, 1, -1), 0.5, 0.5);  // parallel, inside
  check_time(lowered({1, 0, 0}, {2, 0, 0}, 1, -1), 0.5, 0.5);        // parallel, end to end
  check_time(lowered({-1, 0, 0}, {2, 0, 0}, 1, -1), 0.5, 0.5);       // parallel, around
  check_time(lowered({0.5, 0, 0}, {0.5, 0, 0}, 1, -1), 0.5, 0.5);    // a point
  check_free(lowered({0.5, 0x1p-1074, 0}, {0.5, 1, 0}, 1, -1));
  check_free(lowered({std::nextafter(1, 2), 0, 0}, {2, 0, 0}, 1, -1));
  check_free(lowered({std::nextafter(1, 2), 0, 0}, {std::nextafter(1, 2), 0, 0}, 1, -1));
}

TEST_CASE("motion inside one plane", "[unit][oracle]") {
  // From outside, across the side x = 0; along a side, from beyond its end; never.
  const auto sliding = [](Point p0, Point p1) {
    return Query{
        kVertexFace, {{p0, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {{p1, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}};
  };
  check_time(sliding({-1, 0.25, 0}, {1, 0.25, 0}), 0.5, 0.5);
  check_time(sliding({-1, 0, 0}, {3, 0, 0}), 0.25, 0.25);
  check_time(sliding({2, 0, 0}, {0, 0, 0}), 0.5, 0.5);
  check_time(sliding({-1, 1, 0}, {1, 1, 0}), 0.5, 0.5);  // through the corner
  check_time(sliding({0.25, 0.25, 0}, {5, 5, 0}), 0, 0);
  check_free(sliding({-1, std::nextafter(1, 2), 0}, {1, std::nextafter(1, 2), 0}));
  check_free(sliding({-1, 0.25, 0}, {-0x1p-1074, 0.25, 0}));
  // On one line: two edges meet end to end; one swallows the other; they keep their distance.
  const auto on_line = [](double a0, double a1, double b0, double b1, double move) {
    return Query{kEdgeEdge,
                 {{{a0, a0, 0}, {a1, a1, 0}, {b0, b0, 0}, {b1, b1, 0}}},
                 {{{a0 + move, a0 + move, 0}, {a1 + move, a1 + move, 0}, {b0, b0, 0}, {b1, b1, 0}}}};
  };
  check_time(on_line(0, 1, 2, 3, 2), 0.5, 0.5);
  check_time(on_line(0, 1, 3, 2, 4), 0.25, 0.25);
  check_time(on_line(0, 1, 2, 2, 1), 1, 1);
  check_time(on_line(0, 3, 1, 2, 9), 0, 0);
  check_free(on_line(0, 1, 2, 3, 0.5));
  check_free(on_line(0, 0, 1, 1, 0.5));
}

TEST_CASE("primitives without a normal at the moment of contact only", "[unit][oracle]") {
  // All on the x axis at t = 1/2: edges end to end, and a vertex at the ends of the segment that a face
  // becomes.
  const auto collapsing = [](PairKind kind, double q, double b) {
    Query query;
    query.kind = kind;
    query.t0 = scenes::placed(kind, {{q, 0, -3}, {1, 0, -1}, {b, -1, 0}}, {});
    query.t1 = scenes::placed(kind, {{q, 0, 3}, {1, 0, 1}, {b, 1, 0}}, {});
    return query;
  };
  const double above_1 = std::nextafter(1, 2), above_2 = std::nextafter(2, 3), below_0 = -0x1p-1074;
  check_time(collapsing(kEdgeEdge, 1, -1), 0.5, 0.5);
  check_free(collapsing(kEdgeEdge, above_1, -1));
  check_time(collapsing(kVertexFace, 2, 2), 0.5, 0.5);
  check_time(collapsing(kVertexFace, 0, 2), 0.5, 0.5);
  check_free(collapsing(kVertexFace, above_2, 2));
  check_free(collapsing(kVertexFace, below_0, 2));
}

TEST_CASE("primitives without a normal that touch at their ends at the start", "[unit][oracle]") {
  const auto end_to_end = [](double b0) {
    return Query{kEdgeEdge,
                 {{{0, 0, 0}, {1, 0, 0}, {b0, 0, 0}, {2, 0, 0}}},
                 {{{0, 0, 0}, {1, 0, 0}, {5, 5, 5}, {6, 5, 5}}}};
  };
  check_time(end_to_end(1), 0, 0);
  check_free(end_to_end(std::nextafter(1, 2)));
  const auto on_segment = [](double x) {
    return Query{kVertexFace,
                 {{{x, 0, 0}, {0, 0, 0}, {1, 0, 0}, {2, 0, 0}}},
                 {{{x, 5, 5}, {0, 0, 0}, {1, 0, 0}, {2, 0, 0}}}};
  };
  check_time(on_segment(2), 0, 0);
  check_time(on_segment(0), 0, 0);
  check_free(on_segment(std::nextafter(2, 3)));
  const auto on_point = [](double x) {
    return Query{kVertexFace, {{{x, 0, 0}, {}, {}, {}}}, {{{5, 0, 1}, {}, {}, {}}}};
  };
  check_time(on_point(0), 0, 0);
  check_free(on_point(0x1p-1074));
}

TEST_CASE("an irrational time of impact lies strictly between adjacent doubles", "[unit][oracle]") {
  // f = 2 t^2 - 1: a face that tilts about y while the vertex rises: contact at sqrt(1/2).
  const Query query{kVertexFace,
                    {{{0, 0.25, 1}, {0, 0, 0}, {4, 0, 0}, {0, 1, 0}}},
                    {{{2, 0.25, 1}, {0, 0, 0}, {4, 0, 4}, {0, 1, 0}}}};
  const Truth truth = oracle::exact_ccd(query);
  REQUIRE(truth.collides);
  CHECK(std::nextafter(truth.toi_lo, 1) == truth.toi_hi);
  CHECK(Rational(truth.toi_lo) * Rational(truth.toi_lo) * 2 < 1);
  CHECK(Rational(truth.toi_hi) * Rational(truth.toi_hi) * 2 > 1);
}

TEST_CASE("contacts and misses by construction", "[property][oracle]") {
  oracle::for_all_families(
      oracle::fuzz(40), 11, [](const scenes::Family& family, const Query& query, scenes::Random&) {
        const Truth truth = oracle::exact_ccd(query);
        if (family.expect == scenes::Expect::contact) CHECK(truth.collides);
        if (family.expect == scenes::Expect::free) CHECK_FALSE(truth.collides);
        if (!truth.collides) return;
        const bool bracketed =
            truth.toi_lo == truth.toi_hi || std::nextafter(truth.toi_lo, 2) == truth.toi_hi;
        CHECK(bracketed);
        CHECK(truth.toi_lo >= 0);
        CHECK(truth.toi_hi <= 1);
      });
}

// The same question put differently: other relative vectors, other axes, other boundary segments.
static std::vector<Query> equivalent(const Query& query) {
  const auto permuted = [&](std::array<int, 4> order, std::array<int, 3> axes, double s) {
    Query result = query;
    for (int i = 0; i < 4; ++i)
      for (int k = 0; k < 3; ++k) {
        result.t0[i][k] = s * query.t0[order[i]][axes[k]];
        result.t1[i][k] = s * query.t1[order[i]][axes[k]];
      }
    return result;
  };
  if (query.kind == kVertexFace)
    return {permuted({0, 2, 3, 1}, {1, 2, 0}, 1), permuted({0, 1, 3, 2}, {0, 1, 2}, -1),
            permuted({0, 3, 2, 1}, {2, 1, 0}, 1)};
  return {permuted({1, 0, 2, 3}, {1, 2, 0}, 1), permuted({2, 3, 0, 1}, {0, 1, 2}, -1),
          permuted({3, 2, 1, 0}, {2, 1, 0}, 1), permuted({0, 1, 3, 2}, {0, 2, 1}, 1)};
}

TEST_CASE("the answer does not depend on the order of points, axes, signs or the direction of time",
          "[property][oracle]") {
  oracle::for_all_families(oracle::fuzz(10), 12,
                           [](const scenes::Family&, const Query& query, scenes::Random&) {
                             const Truth truth = oracle::exact_ccd(query);
                             for (const Query& other : equivalent(query)) {
                               const Truth same = oracle::exact_ccd(other);
                               CHECK(same.collides == truth.collides);
                               CHECK(same.toi_lo == truth.toi_lo);
                               CHECK(same.toi_hi == truth.toi_hi);
                             }
                             Query backwards = query;
                             std::swap(backwards.t0, backwards.t1);
                             CHECK(oracle::exact_ccd(backwards).collides == truth.collides);
                           });
}

TEST_CASE("two number types, integers and fractions, give the same answer", "[property][oracle]") {
  oracle::for_all_families(2, 13, [](const scenes::Family& family, const Query& query, scenes::Random&) {
    if (std::string(family.name) == "mixed_magnitudes") return;  // slow
    using Q = oracle::PortableRational;
    std::array<oracle::Vector<Q>, 4> x0, x1;
    for (int i = 0; i < 4; ++i)
      for (int k = 0; k < 3; ++k) x0[i][k] = Q(query.t0[i][k]), x1[i][k] = Q(query.t1[i][k]);
    const auto time = oracle::FirstContact<Q>(query.kind, x0, x1).time();
    const Truth truth = oracle::exact_ccd(query);
    REQUIRE(time.has_value() == truth.collides);
    if (!time) return;
    CHECK(time->lo == truth.toi_lo);
    CHECK(time->hi == truth.toi_hi);
  });
}

static oracle::Relative<Rational> relative_at(const Query& query, double t) {
  std::array<oracle::Vector<Rational>, 4> x;
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 3; ++k)
      x[i][k] = Rational(query.t0[i][k]) * (1 - Rational(t)) + Rational(query.t1[i][k]) * Rational(t);
  return oracle::relative(query.kind, x);
}

// d is the shortest vector of a convex set iff it is in the set and no corner c has c.d < d.d. The sampled
// points show that nothing in the set is shorter; the corners show that the plane through d separates all of
// it from the origin.
TEST_CASE("the shortest difference is proved shortest by a separating plane", "[property][oracle]") {
  oracle::for_all_families(oracle::fuzz(6), 14,
                           [](const scenes::Family&, const Query& query, scenes::Random&) {
                             for (double t : {0.0, 0.375, 1.0}) {
                               const auto r = relative_at(query, t);
                               const auto d = oracle::shortest_difference(r);
                               const Rational dd = oracle::dot(d, d);
                               for (const auto& corner : oracle::corners(r))
                                 CHECK(oracle::dot(corner, d) >= dd);
                               const int steps = 4;
                               for (int i = 0; i <= steps; ++i)
                                 for (int j = 0; j <= (query.kind == kEdgeEdge ? steps : steps - i); ++j) {
                                   const auto x = r.q - oracle::scaled<Rational>(Rational(i) / steps, r.a) -
                                                  oracle::scaled<Rational>(Rational(j) / steps, r.b);
                                   CHECK(oracle::dot(x, x) >= dd);
                                 }
                             }
                           });
}

TEST_CASE("the maximum-norm distance is where the cube first meets the polygon", "[property][oracle]") {
  oracle::for_all_families(oracle::fuzz(4), 15,
                           [](const scenes::Family&, const Query& query, scenes::Random&) {
                             for (double t : {0.0, 0.625}) {
                               const auto r = relative_at(query, t);
                               const Rational d = oracle::maximum_norm_distance(r);
                               CHECK(oracle::within_cube(r, d));
                               if (d > 0)
                                 CHECK_FALSE(oracle::within_cube<Rational>(r, d * (1 - Rational(0x1p-80))));
                               const auto s = oracle::shortest_difference(r);
                               const Rational dd = oracle::dot(s, s);
                               CHECK(d * d <= dd);
                               CHECK(dd <= 3 * d * d);
                             }
                           });
}

TEST_CASE("distances by hand, in both norms", "[unit][oracle]") {
  const Query oblique{kVertexFace,  // over the plane x + y + z = 1 at (1, 1, 1) / 3 + s (1, 1, 1)
                      {{{1, 1, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                      {{{-1, -1, -1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};
  CHECK(oracle::compare_distance(oblique, 0, std::nextafter(2 / std::sqrt(3.0), 0)) > 0);
  CHECK(oracle::distance(oblique, 0).hi >= 2 / std::sqrt(3.0));
  CHECK(oracle::distance2(oblique, 0).lo == oracle::round_down<Rational>(Rational(4) / 3));
  CHECK(oracle::distance(oblique, 0, Norm::maximum).lo == oracle::round_down<Rational>(Rational(2) / 3));
  CHECK(oracle::distance(oblique, 0.25, Norm::maximum).hi == oracle::round_up<Rational>(Rational(1) / 6));
  const Query parallel{kEdgeEdge,
                       {{{0, 0, 0}, {1, 0, 0}, {3, 3, 4}, {2, 3, 4}}},
                       {{{0, 0, 0}, {1, 0, 0}, {1, 3, 4}, {0, 3, 4}}}};
  CHECK(oracle::distance2(parallel, 0).lo == 26);
  CHECK(oracle::distance(parallel, 1).lo == 5);
  CHECK(oracle::distance(parallel, 1).hi == 5);
  CHECK(oracle::distance(parallel, 1, Norm::maximum).hi == 4);
  CHECK(oracle::closer_than(parallel, 1, std::nextafter(5, 6)));
  CHECK_FALSE(oracle::closer_than(parallel, 1, 5));
  CHECK(oracle::compare_distance(parallel, 1, 4, Norm::maximum) == 0);
  const Query tiny = scaled(parallel, 0x1p-1074);  // squares far below the smallest double
  CHECK(oracle::distance(tiny, 1).lo == 5 * 0x1p-1074);
  CHECK(oracle::distance2(tiny, 1).lo == 0);
}
