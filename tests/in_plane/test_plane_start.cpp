// Whether a start in the plane will do: edges that cross, vertices on edges, what starts in contact.
#include "tests/catch.hpp"
#include "tests/in_plane/support/plane_scenes.hpp"
#include "tests/oracle/promises.hpp"

using namespace onset;
using namespace onset::tests;

namespace {

PlaneScene two_edges(const std::array<double, 8>& x) {
  PlaneScene s;
  s.x_t0 = Eigen::Map<const Eigen::Matrix<double, 4, 2, Eigen::RowMajor>>(x.data());
  s.x_t1 = s.x_t0;
  s.edges = edge_matrix({{0, 1}, {2, 3}});
  return s;
}

}  // namespace

TEST_CASE("in the plane: intersections of two edges are of three kinds") {
  const auto found = [](const std::array<double, 8>& x) {
    const PlaneScene s = two_edges(x);
    return intersections(s.mesh(), s.x_t0).pairs;
  };
  const auto crossing = found({-1, 0, 1, 0, 0, -1, 0, 1});
  REQUIRE(crossing.size() == 1);
  CHECK((crossing[0].kind == IntersectionKind::crossing && crossing[0].edge == 0 && crossing[0].face == 1));
  CHECK(crossing[0].vertices == std::array<int, 5>{0, 1, 2, 3, 3});
  const auto touching = found({-1, 0, 1, 0, 0, 0, 0, 1});
  REQUIRE(touching.size() == 1);
  CHECK(touching[0].kind == IntersectionKind::touching);
  const auto overlapping = found({-1, 0, 1, 0, 0.5, 0, 3, 0});
  REQUIRE(overlapping.size() == 1);
  CHECK(overlapping[0].kind == IntersectionKind::overlapping);
  CHECK(found({-1, 0, 1, 0, 1.5, 0, 3, 0}).empty());
  CHECK(found({-1, 0, 1, 0, 0, 1e-300, 0, 1}).empty());
}

TEST_CASE("in the plane: intersections are exact") {
  scenes::Random random(oracle::fuzz_seed());
  int met = 0;
  for (int i = 0; i < oracle::fuzz(20'000); ++i) {
    std::array<double, 8> x;
    for (double& c : x)
      c = i % 2 == 0 ? double(scenes::integer(random, -3, 3)) : scenes::uniform(random, -1, 1);
    if (i % 4 == 1) {  // the third point is near the first edge
      const double t = scenes::unit(random);
      x[4] = (1 - t) * x[0] + t * x[2], x[5] = (1 - t) * x[1] + t * x[3];
    }
    const PlaneScene s = two_edges(x);
    const bool expected = edges_meet({x[0], x[1]}, {x[2], x[3]}, {x[4], x[5]}, {x[6], x[7]});
    met += expected;
    INFO(i);
    CHECK(has_intersections(s.mesh(), s.x_t0) == expected);
  }
  CHECK(met > oracle::fuzz(3000));
}

TEST_CASE("in the plane: check finds what crosses and touches, and steps do not begin there") {
  const PlaneScene on = two_edges({-1, 0, 1, 0, 0, 0, 0, 1});
  const StartReport report = check(on.mesh(), on.x_t0);
  CHECK_FALSE(report.acceptable());
  REQUIRE(report.touching.size() == 1);
  CHECK((report.touching[0].kind == PairKind::vertex_edge && report.touching[0].a == 2 &&
         report.touching[0].b == 0));
  CHECK(report.intersections.size() == 1);
  CHECK(report.findings[0].text.find("1 pair of edges intersects (0 crossing), first edge 0") == 0);
  PlaneScene pressed = on;
  pressed.x_t1.row(2) << 0, -0.5;
  const StepResult r = compute_collision_free_stepsize(pressed.mesh(), pressed.x_t0, pressed.x_t1);
  CHECK((r.step == 0 && r.outcome == Outcome::initial_contact));
  CollisionRules rules;
  rules.excluded_pairs = {report.touching[0]};
  rules.excluded_intersections = report.intersections;
  CHECK(check(on.mesh(rules), on.x_t0).acceptable());
  CHECK(compute_collision_free_stepsize(pressed.mesh(rules), pressed.x_t0, pressed.x_t1).step > 0);

  const PlaneScene apart = two_edges({-1, 0, 1, 0, 0, 0.25, 0, 1});
  CHECK(check(apart.mesh(), apart.x_t0).clean());
  Options options;
  options.min_separation = 0.5;
  const StartReport close = check(apart.mesh(), apart.x_t0, options);
  REQUIRE(close.within_separation.size() == 1);
  CHECK(close.within_separation[0].distance == 0.25);
}

TEST_CASE("in the plane: edges that cross are found whatever their ends may meet, and others beside") {
  for (const bool beside : {false, true}) {
    Eigen::MatrixXd x(6, 2);
    x << -1, 0, 1, 0, 0, -1, 0, 1, 50, 50, 51, 50;
    Eigen::MatrixXi edges(3, 2);
    edges << 0, 1, 2, 3, 4, 5;
    CollisionRules rules;  // no vertex meets any edge
    rules.groups = {1, 0, 1, 0, 1, 1}, rules.masks = {0, 1, 0, 1, 1, 1};
    if (!beside) edges.conservativeResize(2, 2);
    CHECK(intersections(Mesh::in_plane(6, edges, rules), x).pairs.size() == 1);
  }
}

TEST_CASE("in the plane: a pair within its separation may part, and is met again later") {
  PlaneScene s;
  s.x_t0.resize(3, 2), s.x_t1.resize(3, 2);
  s.x_t0 << 0, 0.125, -1, 0, 1, 0;
  s.x_t1 << 0, 4, -1, 0, 1, 0;
  s.edges = edge_matrix({{1, 2}});
  Options options;
  options.min_separation = 0.25;
  CHECK(compute_collision_free_stepsize(s.mesh(), s.x_t0, s.x_t1, options).step == 1);
  const ActiveSet set = construct_active_set(s.mesh(), s.x_t0, s.x_t1, options);
  REQUIRE(set.size() == 1);
  CHECK(set[0].outcome == PairOutcome::initial_separating);
  s.x_t1(0, 1) = -1;
  CHECK(compute_collision_free_stepsize(s.mesh(), s.x_t0, s.x_t1, options).step == 0);
}
