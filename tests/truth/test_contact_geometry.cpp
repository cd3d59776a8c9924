// The geometric fields of the active set against exact arithmetic at the toi.
#include <cmath>
#include <cstdlib>
#include <limits>
#include <onset/onset.hpp>
#include <string>

#include "tests/catch.hpp"
#include "tests/fuzz.hpp"
#include "tests/oracle/arithmetic/rational.hpp"
#include "tests/oracle/distance.hpp"
#include "tests/queries/random_query.hpp"
#include "tests/scenes/families.hpp"
#include "tests/src/support/one_pair.hpp"

using namespace onset;
using oracle::cross;
using oracle::dot;
using oracle::Rational;
using oracle::operator-;
using scenes::Query;
using Exact = oracle::Vector<Rational>;

namespace {

Exact exact(const Point& p) { return {Rational(p[0]), Rational(p[1]), Rational(p[2])}; }

std::array<Exact, 4> positions(const Query& q, double t) {
  std::array<Exact, 4> x;
  for (int i = 0; i < 4; ++i)
    x[i] = exact(q.t0[i]) - oracle::scaled<Rational>(Rational(t), exact(q.t0[i]) - exact(q.t1[i]));
  return x;
}
double norm(const Exact& v) { return std::sqrt(oracle::round_up<Rational>(dot(v, v))); }

// Upper bound of the largest corner difference's Euclidean norm.
double rho_of(const Query& q) {
  double r = 0;
  const int first = scenes::first_body(q.kind);
  for (const auto* end : {&q.t0, &q.t1})
    for (int i = 0; i < first; ++i)
      for (int j = first; j < 4; ++j) r = std::max(r, norm(exact((*end)[i]) - exact((*end)[j])));
  return 2 * r;  // the bound adds up the largest magnitude of each axis
}

struct Row {
  const Query& query;
  const ActiveSet& set;
  double d;

  double speed_share() const {  // of the speed of the contact points
    const double motion = norm(difference(positions(query, 1)) - difference(positions(query, 0)));
    return motion > 0 ? set[0].speed / motion : 0;
  }
  void check() const {
    const auto& w = set[0].weights;
    const auto& n = set[0].normal;
    const std::array<Exact, 4> x = positions(query, set[0].toi);
    const double rho = rho_of(query), noise = 64 * 0x1p-53 * rho;
    const int first = scenes::first_body(query.kind);
    double sums[2] = {0, 0};
    for (int i = 0; i < 4; ++i) {
      const double along = i < first ? w[i] : -w[i];
      CHECK((along >= 0 && along <= 1));
      sums[i >= first] += along;
    }
    CHECK(sums[0] == 1);
    CHECK(sums[1] == 1);

    const Exact apart = difference(x);
    const double size = norm(apart),
                 least = norm(oracle::shortest_difference(oracle::relative(query.kind, x)));
    CAPTURE(size, least, noise, set[0].gap, n[0], n[1], n[2]);
    CHECK(size <= least + noise);
    CHECK(std::fabs(set[0].gap - size) <= noise);
    if (set[0].outcome != PairOutcome::max_checks)
      CHECK(size <= (d + set.stats.achieved_tolerance) * (1 + 0x1p-40) + noise);

    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    CHECK(std::fabs(length - 1) <= 0x1p-50);
    // Nothing but noise on the wrong side, and where the gap is resolved, along it.
    const double along = double(dot(exact(n), apart));
    CHECK(along >= -noise);
    if (size > 0x1p14 * noise) CHECK(along >= size * (1 - 0x1p-6));
    const double speed =
        double(dot(exact(n), difference(positions(query, 1)) - difference(positions(query, 0))));
    CHECK(std::fabs(set[0].speed - speed) <= 4 * noise);
    const auto strictly = [](double weight) { return std::fabs(weight) > 0x1p-30; };
    if (!set[0].degenerate && std::all_of(w.begin(), w.end(), strictly)) check_square(x, n, noise);
    if (least > 0x1p-40 * rho) CHECK_FALSE(set[0].degenerate);
  }

 private:
  Exact difference(const std::array<Exact, 4>& x) const {
    Exact sum{0, 0, 0};
    for (int i = 0; i < 4; ++i) sum = sum - oracle::scaled<Rational>(Rational(-set[0].weights[i]), x[i]);
    return sum;
  }
  // Inside both primitives: the paper's normal.
  void check_square(const std::array<Exact, 4>& x, const Point& n, double noise) const {
    const auto r = oracle::relative(query.kind, x);
    const Exact c = cross(r.a, r.b);
    const double size = norm(c);
    const double off = norm(cross(exact(n), c));
    CAPTURE(size, off);
    CHECK(off <= size * 0x1p-8 + noise * noise);
  }
};

// Returns whether there was a contact.
bool check(const Query& query, double d, double tolerance, bool closes) {
  Options options;
  options.min_separation = d;
  options.relative_tolerance = tolerance;
  const ActiveSet set = construct_active_set(tests::mesh_of(query.kind), tests::positions(query.t0),
                                             tests::positions(query.t1), options);
  if (set.size() == 0) return false;
  INFO(to_text(query));
  CAPTURE(d, set[0].toi, to_string(set[0].outcome), int(set[0].degenerate));
  const Row row{query, set, d};
  row.check();
  // Generic pairs close, unless they slide past: the normal points to where they came from.
  if (closes && set[0].outcome == PairOutcome::contact && std::fabs(row.speed_share()) > 0x1p-10)
    CHECK(row.speed_share() < 0);
  return true;
}

std::uint64_t seed() {
  const char* text = std::getenv("ONSET_FUZZ_SEED");
  return text ? std::strtoull(text, nullptr, 10) : 1;
}

}  // namespace

TEST_CASE("contact points, normals and gaps of random pairs are the exact ones", "[oracle][property]") {
  scenes::Random random(seed());
  int contacts = 0, inside = 0;
  for (int i = 0; i < tests::fuzz(2000); ++i)
    for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
      const Query query = i % 2 ? scenes::interior_query(kind, random) : scenes::mixed_query(kind, random);
      const double d = i % 3 == 0 ? 0.01 : 0;
      contacts += check(query, d, i % 5 == 0 ? 1e-12 : 1e-6, true);
      inside += i % 2;
    }
  CHECK(contacts >= inside);
}

TEST_CASE("contact points, normals and gaps of degenerate pairs are finite and oriented",
          "[oracle][property]") {
  int contacts = 0;
  for (const scenes::Family& family : scenes::families())
    for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
      scenes::Random random = scenes::seeded(family, kind, seed() + 10);
      INFO(family.name << " " << scenes::name(kind));
      for (int i = 0; i < tests::fuzz(20); ++i) {
        const Query query = family.make(kind, random);
        double extent = 0;
        for (const auto* end : {&query.t0, &query.t1})
          for (const Point& p : *end)
            for (int a = 0; a < 3; ++a) extent = std::max(extent, std::fabs(p[a] - query.t0[0][a]));
        if (!(extent < 0x1p500 && extent > 0x1p-400)) continue;  // norm() squares
        contacts += check(query, i % 4 == 3 ? 1e-3 * extent : 0, i % 2 ? 1e-10 : 1e-6, false);
      }
    }
  CHECK(contacts > 100);
}

TEST_CASE("a vertex that falls on a face has the face's normal on its own side", "[unit]") {
  for (const double side : {1.0, -1.0}) {
    const Query query{PairKind::vertex_face,
                      {{{0.25, 0.25, side}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
                      {{{0.25, 0.25, -side}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}};
    const ActiveSet set = construct_active_set(tests::mesh_of(query.kind), tests::positions(query.t0),
                                               tests::positions(query.t1));
    REQUIRE(set.size() == 1);
    CHECK(set[0].normal == Point{0, 0, side});
    CHECK(set[0].weights == std::array<double, 4>{1, -0.5, -0.25, -0.25});
    CHECK(set[0].speed == -2);
    CHECK(set[0].gap <= set.stats.achieved_tolerance);
    CHECK_FALSE(set[0].degenerate);
  }
}

TEST_CASE("pairs without a cross product have the normal of their gap, or touching, one from where they came",
          "[unit]") {
  // Parallel edges, one above the other; a vertex onto a face that is a segment, and onto one that is a
  // point.
  const Query edges{PairKind::edge_edge,
                    {{{0, 0, 1}, {1, 0, 1}, {0.5, 0, 0}, {1.5, 0, 0}}},
                    {{{0, 0, -1}, {1, 0, -1}, {0.5, 0, 0}, {1.5, 0, 0}}}};
  const Query segment{PairKind::vertex_face,
                      {{{0.25, 0, 1}, {0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}}},
                      {{{0.25, 0, -1}, {0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}}}};
  const Query point{PairKind::vertex_face,
                    {{{0, 0, 1}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}},
                    {{{0, 0, -1}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}}};
  for (const Query& query : {edges, segment, point})
    for (const double from :
         {1.0, 0.0}) {  // falling from above; touching at the start, then parting downwards
      Query q = query;
      for (int i = 0; i < scenes::first_body(q.kind); ++i) q.t0[i][2] = from;
      Options o;
      o.touching_may_pass_through = true;
      const ActiveSet set =
          construct_active_set(tests::mesh_of(q.kind), tests::positions(q.t0), tests::positions(q.t1), o);
      REQUIRE(set.size() == 1);
      CAPTURE(scenes::name(q.kind), from);
      CHECK(set[0].normal == Point{0, 0, from == 1 ? 1.0 : -1.0});
      CHECK(set[0].degenerate == (from != 1));
    }
}

TEST_CASE("pairs that meet along an edge or within a plane are divided across their way", "[unit]") {
  // Two edges on one line, end on end; a vertex that slides down in the face's plane onto its upper edge.
  const Query ends{PairKind::edge_edge,
                   {{{0, 0, 2}, {0, 0, 3}, {0, 0, 0}, {0, 0, 1}}},
                   {{{0, 0, 0}, {0, 0, 1}, {0, 0, 0}, {0, 0, 1}}}};
  const Query slide{PairKind::vertex_face,
                    {{{0.25, 0, 2}, {0, 0, 0}, {1, 0, 1}, {-1, 0, 1}}},
                    {{{0.25, 0, 0.5}, {0, 0, 0}, {1, 0, 1}, {-1, 0, 1}}}};
  for (const Query& q : {ends, slide}) {
    const ActiveSet set =
        construct_active_set(tests::mesh_of(q.kind), tests::positions(q.t0), tests::positions(q.t1));
    REQUIRE(set.size() == 1);
    CAPTURE(scenes::name(q.kind));
    CHECK(set[0].normal == Point{0, 0, 1});
    CHECK_FALSE(set[0].degenerate);
  }
}

TEST_CASE("constraints hold at the start of a step and tell how far its end is through", "[unit]") {
  scenes::Random random(seed() + 20);
  int rows = 0;
  for (int i = 0; i < 50; ++i) {
    const Query query = scenes::interior_query(i % 2 ? PairKind::vertex_face : PairKind::edge_edge, random);
    const Eigen::MatrixXd x0 = tests::positions(query.t0), x1 = tests::positions(query.t1);
    const ActiveSet set = construct_active_set(tests::mesh_of(query.kind), x0, x1);
    REQUIRE(set.size() == 1);
    const std::vector<int> full{7, 3, 5, 0};
    const Constraints c = assemble_constraints(set, 1e-3, full);
    REQUIRE(c.rows() == 1);
    REQUIRE(c.dof.size() == 12);
    CHECK(c.bound[0] == 1e-3);
    Eigen::VectorXd start = Eigen::VectorXd::Zero(24), end = start;
    for (int v = 0; v < 4; ++v)
      start.segment<3>(3 * full[v]) = x0.row(v), end.segment<3>(3 * full[v]) = x1.row(v);
    double at_start = 0, at_end = 0;
    for (std::size_t k = 0; k < 12; ++k)
      at_start += c.value[k] * start[c.dof[k]], at_end += c.value[k] * end[c.dof[k]];
    const double toi = set[0].toi, gap = set[0].gap;
    CHECK(std::fabs(at_start + toi * set[0].speed - gap) < 1e-13);
    CHECK(std::fabs(at_end - (1 - toi) * set[0].speed - gap) < 1e-13);
    rows += at_start > 0;
  }
  CHECK(rows == 50);
}

TEST_CASE("a map that cannot number the columns is rejected", "[unit]") {
  ActiveSet set;
  Contact contact;
  contact.vertices = {0, 1, 2, 3};
  contact.weights = {1, -1, 0, 0};
  contact.normal = {0, 0, 1};
  set.contacts = {contact};
  CHECK(assemble_constraints(set).dof[11] == 11);
  CHECK_THROWS_AS(assemble_constraints(set, 0, {0, 1, 2}), std::invalid_argument);
  CHECK_THROWS_AS(assemble_constraints(set, 0, {0, 1, 2, -1}), std::invalid_argument);
  CHECK_THROWS_AS(assemble_constraints(set, 0, {0, 1, 2, 2}), std::invalid_argument);
  CHECK_THROWS_AS(assemble_constraints(set, 0, {0, 1, 2, 2000000000}), std::invalid_argument);
  CHECK_THROWS_AS(assemble_constraints(set, NAN), std::invalid_argument);
}
