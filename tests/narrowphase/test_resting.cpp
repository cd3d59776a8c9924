// Resting contact is not contact: a pair that starts apart and never loses three quarters of its gap is free,
// however the gap compares with the tolerance (narrowphase/kernel/advance.inl, stop rule).
#include "tests/catch.hpp"
#include "tests/fuzz.hpp"
#include "tests/narrowphase/samples.hpp"
#include "tests/narrowphase/separation.hpp"
#include "tests/queries/random_query.hpp"

using namespace onset;
using namespace onset::tests;
using scenes::Query;
using scenes::Random;

namespace {

Point jitter(Random& random) { return scenes::times(0x1p-11, scenes::grid_point(random, 10)); }

// The first body lies in the plane z = gap, the second in z = 0, and seen along z they cross, wherever jitter
// moves their points: `gap` is the distance. All coordinates are on a grid.
std::array<Point, 4> crossing(PairKind kind, double gap, Random& random) {
  std::array<Point, 4> x = kind == PairKind::vertex_face
                               ? std::array<Point, 4>{Point{0, 0, 0}, {-8, -8, 0}, {8, -8, 0}, {0, 16, 0}}
                               : std::array<Point, 4>{Point{-8, 0, 0}, {8, 0, 0}, {0, -8, 0}, {0, 8, 0}};
  for (int i = 0; i < 4; ++i) {
    x[i] = scenes::plus(x[i], jitter(random));
    x[i][2] = i < scenes::first_body(kind) ? gap : 0;
  }
  return x;
}

// Moves every point inside its plane.
void slide(std::array<Point, 4>& x, Random& random) {
  for (Point& p : x) {
    const Point step = jitter(random);
    p[0] += step[0], p[1] += step[1];
  }
}

// At `distance` at the start; it slides, and comes closer by so much.
Query sliding(PairKind kind, double distance, double closer, Random& random) {
  Query query{kind, crossing(kind, distance, random), {}};
  query.t1 = query.t0;
  slide(query.t1, random);
  for (int i = 0; i < scenes::first_body(kind); ++i) query.t1[i][2] -= closer;
  return query;
}

void expect_free(const char* what, const Query& query, double d = 0, Norm norm = Norm::euclidean) {
  for (double tolerance : {1e3, 1e-2, 1e-6, 1e-10, 1e-14}) {
    Options o;
    o.relative_tolerance = tolerance;
    o.min_separation = d;
    o.norm = norm;
    const QueryResult r = ccd(query, o);
    if (r.outcome != PairOutcome::free || r.toi != INFINITY)
      FAIL_CHECK(what << "\n  " << to_text(query) << "\n  " << oracle::to_text(o, r));
  }
}

// f(kind, gap, random) for both kinds and gaps of 2^-40 .. 2^-2.
template <class F>
void for_gaps(std::uint64_t seed, F&& f) {
  for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
    Random random(seed);
    for (int i = 0; i < fuzz(300); ++i) f(kind, std::ldexp(1.0, -scenes::integer(random, 2, 40)), random);
  }
}

void turn_and_scale(Query& query, Random& random) {
  query = transformed(query, scenes::signed_permutation(random));
  query = scenes::scaled(query, std::ldexp(1.0, scenes::integer(random, -30, 30)));
}

}  // namespace

TEST_CASE("a pair at rest, or carried along, is free at any gap", "[property]") {
  for_gaps(41, [](PairKind kind, double gap, Random& random) {
    Query query{kind, crossing(kind, gap, random), {}};
    for (Point& p : query.t0) p = scenes::plus(p, {0, 0, 0.5 * p[0]});  // tilted: the gap is smaller
    const Point step = scenes::coin(random) ? Point{} : scenes::grid_point(random, 3);
    for (int i = 0; i < 4; ++i) query.t1[i] = scenes::plus(query.t0[i], step);
    turn_and_scale(query, random);
    expect_free("carried along", query);
  });
}

TEST_CASE("a pair that slides at a constant gap is free", "[property]") {
  for_gaps(42, [](PairKind kind, double gap, Random& random) {
    Query query = sliding(kind, gap, 0, random);
    turn_and_scale(query, random);
    expect_free("sliding", query);
  });
}

TEST_CASE("a pair that grows apart is free at any gap", "[property]") {
  for_gaps(43, [](PairKind kind, double gap, Random& random) {
    Query query = sliding(kind, gap, -gap * scenes::integer(random, 1, 9), random);
    turn_and_scale(query, random);
    expect_free("growing", query);
  });
}

TEST_CASE("an approach that keeps a quarter of the gap is free", "[property]") {
  for_gaps(44, [](PairKind kind, double gap, Random& random) {
    Query query = sliding(kind, gap, scenes::uniform(random, 0, 0.74) * gap, random);
    turn_and_scale(query, random);
    expect_free("approaching", query);
  });
}

// The same above a separation: what counts is the gap beyond d.
TEST_CASE("beyond a minimum separation resting pairs are free as well", "[property]") {
  for (Norm norm : {Norm::euclidean, Norm::maximum})
    for_gaps(45, [&](PairKind kind, double gap, Random& random) {
      const double d = std::ldexp(1.0, -scenes::integer(random, 0, 20));
      Query query = sliding(kind, d + gap, scenes::uniform(random, -1, 0.7) * gap, random);
      query = transformed(query, scenes::signed_permutation(random));
      expect_free("beyond d", query, d, norm);
    });
}

// What these tests show is not blindness: an approach that closes the gap is found, at the end of its first
// three quarters or later, at any tolerance.
TEST_CASE("an approach that closes the gap is reported", "[property]") {
  for_gaps(46, [](PairKind kind, double gap, Random& random) {
    Query query = sliding(kind, gap, 2 * gap, random);
    turn_and_scale(query, random);
    for (double tolerance : {1e3, 1e-6, 1e-14}) {
      Options o;
      o.relative_tolerance = tolerance;
      const QueryResult r = ccd(query, o);
      const std::string broken = broken_promise(query, o, r);
      if (r.outcome != PairOutcome::contact || r.toi < 0.3749 || !broken.empty())
        FAIL_CHECK(broken << "\n  " << to_text(query) << "\n  " << oracle::to_text(o, r));
    }
  });
}
