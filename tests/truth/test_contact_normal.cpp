// Normals of resting, grazing and parting contacts against the exact side that the pair came from.
//
// ONSET_FUZZ=300 for a million, ONSET_SEED=n for others.
#include <algorithm>
#include <cstring>
#include <onset/onset.hpp>

#include "tests/catch.hpp"
#include "tests/narrowphase/kernel/kernels.hpp"
#include "tests/narrowphase/symmetries.hpp"
#include "tests/oracle/promises.hpp"
#include "tests/queries/random_query.hpp"
#include "tests/src/support/one_pair.hpp"
#include "tests/truth/exact_row.hpp"

using namespace onset;
using namespace onset::tests;
using scenes::Query;
using scenes::Random;

namespace {

bool same_bytes(const ActiveSet& a, const ActiveSet& b) {
  const auto numbers = [](const Contact& c) {
    std::vector<double> all{c.toi, c.gap, c.speed, double(c.degenerate)};
    all.insert(all.end(), c.weights.begin(), c.weights.end());
    all.insert(all.end(), c.normal.begin(), c.normal.end());
    return all;
  };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](const Contact& c, const Contact& d) {
    const std::vector<double> x = numbers(c), y = numbers(d);
    return std::memcmp(x.data(), y.data(), x.size() * sizeof(double)) == 0;
  });
}

// The other winding of the face; the first edge run the other way.
Query turned(Query q) {
  for (auto* x : {&q.t0, &q.t1})
    std::swap((*x)[q.kind == PairKind::vertex_face ? 2 : 0], (*x)[q.kind == PairKind::vertex_face ? 3 : 1]);
  return q;
}

// At all levels of certainty, with both kernels and both windings.
void check_all(const Query& query, Past past, Options o, Counts& counts) {
  for (const Query& q : {query, turned(query)})
    for (const Exactness level : {Exactness::conservative, Exactness::certify, Exactness::exact}) {
      o.exactness = level, o.instruction_set = InstructionSet::scalar, o.threads = 1;
      const Mesh mesh = mesh_of(q.kind);
      const Eigen::MatrixXd x0 = positions(q.t0), x1 = positions(q.t1);
      const ActiveSet set = construct_active_set(mesh, x0, x1, o);
      for (const InstructionSet kernel : kernels()) {
        o.instruction_set = kernel;
        CHECK(same_bytes(set, construct_active_set(mesh, x0, x1, o)));
      }
      if (set.size() == 0) continue;
      INFO(scenes::to_text(q));
      CAPTURE(int(level), o.min_separation, o.touching_may_pass_through);
      const Past here = set[0].outcome == PairOutcome::initial_separating ? Past::parting
                        : set[0].outcome == PairOutcome::contact          ? past
                                                                          : Past::any;
      RowCheck(q, set).check(here, counts);
    }
}

// Coordinates on a grid of 2^-10 within a few units; exact at all times that are used here.
Point grid(Random& random, double reach = 1) {
  Point p;
  for (double& x : p) x = scenes::integer(random, -int(1024 * reach), int(1024 * reach)) * 0x1p-10;
  return p;
}
double quarter(Random& random) { return scenes::integer(random, 1, 3) * 0.25; }

// A pair that touches, exactly, inside both primitives or at the boundary of one, at one time; `across` is
// not 0.
struct Touching {
  std::array<Point, 4> x, v;  // then, and the velocities: the first moves as the other does, at the contact
  Point across, along;        // a x b, and a direction within the plane

  Touching(PairKind kind, bool boundary, Random& random) {
    double U = quarter(random) / 2, V = quarter(random) / 2;
    if (boundary) (scenes::coin(random) ? U : V) = 0;
    const bool triangle = kind == PairKind::vertex_face;
    for (Point& p : v) p = grid(random, 0.25);
    meet(triangle, U, V, grid(random, 0.25), v);
    do {
      for (Point& p : x) p = grid(random);
      meet(triangle, U, V, grid(random), x);
      const Point a = triangle ? scenes::minus(x[2], x[1]) : scenes::minus(x[1], x[0]);
      const Point b = triangle ? scenes::minus(x[3], x[1]) : scenes::minus(x[3], x[2]);
      for (std::size_t i = 0; i < 3; ++i)
        across[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
      along = scenes::plus(scenes::times(scenes::integer(random, -2, 2) * 0.25, a),
                           scenes::times(scenes::integer(random, -2, 2) * 0.25, b));
    } while (size(across) < 0.05);
  }
  // The first primitive to the point (U, V); `e`: the first edge.
  static void meet(bool triangle, double U, double V, const Point& e, std::array<Point, 4>& p) {
    using scenes::plus, scenes::times, scenes::minus;
    if (triangle) {
      p[0] = plus(times(1 - U - V, p[1]), plus(times(U, p[2]), times(V, p[3])));
    } else {
      p[0] = minus(plus(times(1 - V, p[2]), times(V, p[3])), times(U, e));
      p[1] = plus(p[0], e);
    }
  }
  static double size(const Point& p) { return std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]); }

  // The whole step, the contact at time t; the first primitive moves by `extra` more.
  Query query(PairKind kind, double t, const Point& extra) const {
    Query q;
    q.kind = kind;
    for (std::size_t i = 0; i < 4; ++i) {
      const Point move = int(i) < scenes::first_body(kind) ? scenes::plus(v[i], extra) : v[i];
      q.t0[i] = scenes::minus(x[i], scenes::times(t, move));
      q.t1[i] = scenes::plus(x[i], scenes::times(1 - t, move));
    }
    return q;
  }
};

Query placed(const Query& q, Random& random) {
  const auto permutations = signed_permutations();
  Query r = mapped(q, permutations[std::size_t(scenes::integer(random, 0, 47))]);
  if (scenes::integer(random, 0, 2) == 0)
    r = scenes::moved(r, {scenes::integer(random, -999, 999) * 1.0, 5, -70});
  if (scenes::integer(random, 0, 2) == 0)
    r = scenes::scaled(r, std::ldexp(1.0, scenes::integer(random, -1050, 950)));
  return r;
}

void print(const char* name, const Counts& c) {
  INFO(name << ": " << c.rows << " rows, " << c.flagged << " flagged, " << c.resolved << " with a gap, "
            << c.inside << " inside");
  CHECK(c.rows > 0);
  if (oracle::fuzz(1) > 1)
    std::printf("%s: %d rows, %d flagged, %d with a gap, %d inside\n", name, c.rows, c.flagged, c.resolved,
                c.inside);
}

template <class Make>
void check_many(const char* name, int count, std::uint64_t which, Past past, Make&& make,
                const Options& options = {}) {
  Counts counts;
  for (const PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
    Random random(oracle::fuzz_seed() * 100 + 2 * which + (kind == PairKind::edge_edge));
    for (int i = 0; i < oracle::fuzz(count); ++i) {
      const Query q = make(kind, random);
      check_all(q, past, options, counts);
    }
  }
  print(name, counts);
}

Options apart_by(double separation) {
  Options o;
  o.min_separation = separation;
  return o;
}

Point tiny_across(const Touching& c, Random& random) {
  const double length = std::ldexp(1.0, -scenes::integer(random, 20, 70)) / Touching::size(c.across);
  return scenes::times(scenes::coin(random) ? length : -length, c.across);
}

}  // namespace

TEST_CASE("resting contacts have their normal on the side they came from", "[oracle][property]") {
  check_many("resting", 120, 1, Past::closing, [](PairKind kind, Random& random) {
    Touching c(kind, scenes::integer(random, 0, 4) == 0, random);
    for (Point& p : c.v) p = {0, 0, 0};
    Query q = c.query(kind, 0.5, {0, 0, 0});
    const Point from = tiny_across(c, random), to = scenes::times(-scenes::power_of_ten(random, -3, 0), from);
    const bool axis = scenes::coin(random);  // as in a solver's floor: along one axis, else rounded
    for (int i = 0; i < scenes::first_body(kind); ++i)
      for (std::size_t a = 0; a < 3; ++a) {
        if (axis && a != 2) continue;
        q.t0[std::size_t(i)][a] += from[a], q.t1[std::size_t(i)][a] += to[a];
      }
    return q;
  });
}

TEST_CASE("contacts at a time that is a double have their normal on the side they came from",
          "[oracle][property]") {
  check_many("exact times", 120, 2, Past::closing, [](PairKind kind, Random& random) {
    const Touching c(kind, scenes::integer(random, 0, 3) == 0, random);
    Point extra = scenes::times(scenes::coin(random) ? 0.25 : -0.25,
                                {std::round(64 * c.across[0]) / 64, std::round(64 * c.across[1]) / 64,
                                 std::round(64 * c.across[2]) / 64});
    extra = scenes::plus(extra, scenes::times(0.125, c.along));
    return placed(c.query(kind, quarter(random), extra), random);
  });
}

TEST_CASE("grazing contacts have their normal on the side they touch from", "[oracle][property]") {
  check_many("grazing", 120, 3, Past::any, [](PairKind kind, Random& random) {
    const Touching c(kind, scenes::integer(random, 0, 4) == 0, random);
    return placed(c.query(kind, quarter(random), c.along), random);
  });
}

TEST_CASE("contacts that touch at the start are flagged, and part along their normal", "[oracle][property]") {
  Options passing;
  passing.touching_may_pass_through = true;
  for (const Options& options : {Options(), passing})
    check_many(
        "touching at the start", 40, 4, Past::any,
        [](PairKind kind, Random& random) {
          const Touching c(kind, scenes::coin(random), random);
          const Point extra = scenes::times(scenes::integer(random, -1, 1) * 0.25, c.across);
          return placed(c.query(kind, 0, scenes::plus(extra, c.along)), random);
        },
        options);
}

TEST_CASE("pairs within a separation that part do so along their normal", "[oracle][property]") {
  check_many(
      "parting", 120, 5, Past::any,
      [](PairKind kind, Random& random) {
        Touching c(kind, scenes::coin(random), random);
        for (Point& p : c.v) p = {0, 0, 0};
        const Point from = tiny_across(c, random);
        const double ahead = scenes::coin(random) ? 0x1p-10 / Touching::size(from) : 0;
        Query q = c.query(kind, 0, scenes::plus(c.along, scenes::times(ahead, from)));
        for (int i = 0; i < scenes::first_body(kind); ++i)
          for (auto* x : {&q.t0, &q.t1}) (*x)[std::size_t(i)] = scenes::plus((*x)[std::size_t(i)], from);
        return q;
      },
      apart_by(0.001));
}

TEST_CASE("contacts of random pairs, with and without a separation, have the normal of their gap",
          "[oracle][property]") {
  const auto make = [](PairKind kind, Random& random) { return scenes::mixed_query(kind, random); };
  check_many("random", 60, 6, Past::any, make);
  check_many("random, apart", 60, 7, Past::any, make, apart_by(0.01));
}

namespace {

ActiveSet active_set(const Query& q, const Options& o = {}) {
  return construct_active_set(mesh_of(q.kind), positions(q.t0), positions(q.t1), o);
}

}  // namespace

TEST_CASE("the normal of a resting contact is that of its side whatever the face's winding", "[unit]") {
  const double h = 0x1p-48;
  const Query q{PairKind::vertex_face,
                {{{0.25, 0.25, h}, {0, 0, 0}, {0, 1, 0}, {1, 0, 0}}},
                {{{0.25, 0.25, -h}, {0, 0, 0}, {0, 1, 0}, {1, 0, 0}}}};
  for (const Query& query : {q, turned(q)}) {
    const ActiveSet set = active_set(query);
    REQUIRE(set.size() == 1);
    CHECK(set[0].normal == Point{0, 0, 1});
    CHECK(set[0].speed == -2 * h);
    CHECK_FALSE(set[0].degenerate);
    const Constraints c = assemble_constraints(set);
    double at_start = 0;
    for (std::size_t k = 0; k < 12; ++k)
      at_start += c.value[k] * query.t0[std::size_t(c.dof[k] / 3)][std::size_t(c.dof[k] % 3)];
    CHECK(at_start == h);
  }
}

TEST_CASE("normals of the smallest positions there are", "[unit]") {
  const double eta = 0x1p-1074;
  const Query q{PairKind::vertex_face,
                {{{2 * eta, 2 * eta, eta}, {0, 0, 0}, {0, 16 * eta, 0}, {16 * eta, 0, 0}}},
                {{{2 * eta, 2 * eta, -eta}, {0, 0, 0}, {0, 16 * eta, 0}, {16 * eta, 0, 0}}}};
  for (const Query& query : {q, turned(q)}) {
    const ActiveSet set = active_set(query);
    REQUIRE(set.size() == 1);
    CHECK(set[0].normal == Point{0, 0, 1});
    CHECK(set[0].speed == -2 * eta);
    CHECK_FALSE(set[0].degenerate);
  }
}

TEST_CASE("the normal of a grazing contact is that of the side it touches from", "[unit]") {
  const Query q{PairKind::vertex_face,
                {{{0.125, 0.1875, 0.125}, {0, 0, 0}, {0, 1, 0.625}, {1, 0, 0}}},
                {{{0.125, 0.3125, 0.125}, {0, 0, 0}, {0, 1, 0.375}, {1, 0, 0}}}};
  Options o;
  for (const Exactness level : {Exactness::conservative, Exactness::certify, Exactness::exact})
    for (const Query& query : {q, turned(q)}) {
      o.exactness = level;
      const ActiveSet set = active_set(query, o);
      REQUIRE(set.size() == 1);
      CHECK(set[0].normal[1] == Approx(-std::sqrt(0.2)).epsilon(1e-5));
      CHECK(set[0].normal[2] == Approx(std::sqrt(0.8)).epsilon(1e-5));
      CHECK_FALSE(set[0].degenerate);
    }
}

TEST_CASE("a contact that parts at a boundary does so along its normal", "[unit]") {
  const Query q{PairKind::edge_edge,
                {{{-1, 0, 0}, {1, 0, 0}, {0, 0, 0x1p-49}, {0, 1, 0.5}}},
                {{{-1, 0, 0}, {1, 0, 0}, {0, 1, 0x1p-49}, {0, 2, 0.5}}}};
  Options o;
  o.min_separation = 0.001;
  const ActiveSet set = active_set(q, o);
  REQUIRE(set.size() == 1);
  CHECK(set[0].outcome == PairOutcome::initial_separating);
  CHECK(set[0].speed > 0);
}

TEST_CASE("a vertex that comes to an edge of a face, or a wire to a parallel one, has the normal of its gap",
          "[unit]") {
  const Query vertex{PairKind::vertex_face,
                     {{{0.5, -0.25, 1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
                     {{{0.5, -0.25, -1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}};
  const Query wires{PairKind::edge_edge,
                    {{{0, -0.25, 1}, {1, -0.25, 1}, {0.5, 0, 0}, {1.5, 0, 0}}},
                    {{{0, -0.25, -1}, {1, -0.25, -1}, {0.5, 0, 0}, {1.5, 0, 0}}}};
  Options o;
  o.min_separation = 0.5;
  for (const Query& q : {vertex, wires}) {
    const ActiveSet set = active_set(q, o);
    REQUIRE(set.size() == 1);
    CHECK_FALSE(set[0].degenerate);
    CHECK(set[0].normal[0] == 0);
    CHECK(set[0].normal[1] == Approx(-0.5).epsilon(1e-5));
    CHECK(set[0].normal[2] == Approx(std::sqrt(0.75)).epsilon(1e-5));
  }
}

namespace {

// How much of p1 - p2 at toi, from the weights in rational arithmetic, lies along the normal; 1: all of it.
double share_along_normal(const std::array<Point, 4>& t0, const std::array<Point, 4>& t1,
                          const QueryResult& r) {
  double gap2 = 0, along = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    oracle::Rational w = 0;
    for (std::size_t k = 0; k < 4; ++k)
      w += oracle::Rational(r.weights[k]) *
           (oracle::Rational(t0[k][a]) +
            oracle::Rational(r.toi) * (oracle::Rational(t1[k][a]) - oracle::Rational(t0[k][a])));
    const double x = static_cast<double>(w);
    gap2 += x * x, along += x * r.normal[a];
  }
  return along / std::sqrt(gap2);
}

// Two that meet exactly at a corner, at a dyadic time, by way of small integers.
Query meeting_at_a_corner(PairKind kind, Random& random) {
  std::array<Point, 4> x, moved;
  for (auto* points : {&x, &moved})
    for (Point& p : *points)
      for (double& c : p) c = scenes::integer(random, -4, 4);
  if (kind == PairKind::vertex_face) {
    x[0] = x[std::size_t(scenes::integer(random, 1, 3))];
  } else {
    const std::size_t e = std::size_t(scenes::integer(random, 0, 1)),
                      f = std::size_t(scenes::integer(random, 2, 3));
    const Point from = x[f];
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t k : {2, 3}) x[k][a] += x[e][a] - from[a];
  }
  const double t = scenes::integer(random, 1, 15) / 16.0;
  Query query{kind, {}, {}};
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t a = 0; a < 3; ++a)
      query.t0[k][a] = x[k][a] - t * moved[k][a], query.t1[k][a] = x[k][a] + (1 - t) * moved[k][a];
  return query;
}

}  // namespace

TEST_CASE("contacts at a corner that ties with a side have the normal of their closest points",
          "[oracle][property]") {
  Random random(oracle::fuzz_seed() + 77);
  int told = 0;
  for (int i = 0; i < oracle::fuzz(4000); ++i) {
    const PairKind kind = i % 2 == 0 ? PairKind::vertex_face : PairKind::edge_edge;
    const Query query = meeting_at_a_corner(kind, random);
    Options options;
    options.exactness = Exactness(i / 2 % 3);
    const QueryResult r = kind == PairKind::vertex_face ? vertex_face_ccd({query.t0, query.t1}, options)
                                                        : edge_edge_ccd({query.t0, query.t1}, options);
    if (!r.collides() || r.degenerate || r.toi == 0 || r.gap < 64 * 0x1p-44) continue;
    ++told;
    INFO(to_text(query));
    REQUIRE(share_along_normal(query.t0, query.t1, r) >= 0.999);
  }
  CHECK(told > oracle::fuzz(1000));
}

TEST_CASE("a contact at a corner that ties with a side has the normal of its closest points",
          "[oracle][regression]") {
  VertexFaceQuery q;
  q.t0 = {{{-1.3125, -.3125, -1}, {1, -1.3125, -1.3125}, {1, .6875, 0}, {-1, .3125, -.6875}}};
  q.t1 = {{{-.3125, .6875, -1}, {1, -.3125, -.3125}, {1, 1.6875, 0}, {-1, -.6875, -1.6875}}};
  const QueryResult r = vertex_face_ccd(q);
  REQUIRE((r.collides() && !r.degenerate));
  CHECK(share_along_normal(q.t0, q.t1, r) >= 0.999);
}
