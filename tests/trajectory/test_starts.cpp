// Where trajectories start close: within a body, within a separation, beside what stands.
#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <onset/onset.hpp>

#include "tests/catch.hpp"
#include "tests/fuzz.hpp"
#include "tests/scenes/random.hpp"
#include "tests/scenes/triangles.hpp"

namespace onset::tests {
namespace {

using Eigen::MatrixXd;
using scenes::any;
using scenes::Random;
using scenes::triangles;
using scenes::uniform;

// Two bodies of the rules, of one triangle each, that may be rigid.
CollisionRules two_bodies(bool first_is_rigid) {
  CollisionRules rules;
  rules.bodies = {0, 0, 0, 1, 1, 1};
  rules.rigid_bodies = {first_is_rigid, true};
  return rules;
}

// A triangle, and a corner of another one within a few u of it.
MatrixXd nearly_touching(Random& random) {
  MatrixXd x(6, 3);
  Eigen::RowVector3d n;
  do {
    for (int v = 0; v < 3; ++v) x.row(v) = any(random, 1);
    const Eigen::RowVector3d a = x.row(1) - x.row(0), b = x.row(2) - x.row(0);
    n = a.cross(b);
  } while (n.norm() < 0.3);
  n.normalize();
  x.row(3) = (x.row(0) + x.row(1) + x.row(2)) / 3 + n * uniform(random, 0, 3e-16);
  x.row(4) = x.row(3) + n + any(random, 0.3), x.row(5) = x.row(3) + n + any(random, 0.3);
  return x;
}

}  // namespace

TEST_CASE("a rigid body that is nearly touched by itself is never stored through itself", "[trajectory]") {
  Random random(811);
  int started = 0, moved = 0;
  for (int i = 0; i < fuzz(2000); ++i) {
    const MatrixXd x = nearly_touching(random);
    const Mesh mesh(x, triangles(2));
    if (has_intersections(mesh, x)) continue;
    ++started;
    RigidTrajectory t(x);
    t.add_body(0, 6, any(random, 3).transpose(), any(random, 1).transpose(), {0, 0, 0});
    const StepResult r = compute_collision_free_stepsize(mesh, t);
    const ActiveSet set = construct_active_set(mesh, t);
    REQUIRE(is_step_collision_free(mesh, t) == (r.outcome == Outcome::free));
    REQUIRE(set.empty() == (r.outcome == Outcome::free));
    if (r.step == 0) {
      REQUIRE((r.outcome == Outcome::below_rounding || r.outcome == Outcome::initial_contact));
      REQUIRE((r.limiting && set.earliest()->toi == 0));
      continue;
    }
    ++moved;
    REQUIRE_FALSE(has_intersections(mesh, t.at(r.step)));
  }
  CHECK(started > fuzz(1000));
  // Far enough from itself it goes.
  MatrixXd x = nearly_touching(random);
  x.bottomRows(3).rowwise() += 1e-13 * (x.row(4) - x.row(3));
  RigidTrajectory t(x);
  t.add_body(0, 6, {0, 1, 0}, {1, 0, 0}, {0, 0, 0});
  CHECK(compute_collision_free_stepsize(Mesh(x, triangles(2)), t).step == 1);
}

TEST_CASE("two bodies of the rules that turn as one meet each other at the start", "[trajectory]") {
  MatrixXd x(6, 3);
  x << 0, 0, 0, 1, 0, 0, 0, 1, 0, .2, .2, 0, .3, .2, 1, .2, .3, 1;
  for (const bool first_is_rigid : {false, true}) {
    const Mesh touching(x, triangles(2), two_bodies(first_is_rigid));
    RigidTrajectory t(x);
    t.add_body(0, 6, {0, 0, 1}, {0, 0, 0}, {0, 0, 0});
    const StepResult r = compute_collision_free_stepsize(touching, t);
    CHECK(r.step == 0);
    CHECK(r.outcome == Outcome::initial_contact);
    CHECK_FALSE(is_step_collision_free(touching, t));
    CHECK(construct_active_set(touching, t).size() > 0);
  }
  Random random(812);
  for (int i = 0; i < fuzz(500); ++i) {  // each is rigid, and apart by less than what is stored of the other
    const MatrixXd near = nearly_touching(random);
    const Mesh mesh(near, triangles(2), two_bodies(scenes::coin(random)));
    if (has_intersections(mesh, near)) continue;
    RigidTrajectory t(near);
    t.add_body(0, 6, any(random, 3).transpose(), any(random, 1).transpose(), {0, 0, 0});
    const StepResult r = compute_collision_free_stepsize(mesh, t);
    if (r.step > 0) REQUIRE_FALSE(has_intersections(mesh, t.at(r.step)));
  }
}

TEST_CASE("what starts within its separation is an initial contact in every call on a trajectory",
          "[trajectory]") {
  MatrixXd x(6, 3);
  x << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0.2, 0.2, 0.1, 0.3, 0.2, 1, 0.2, 0.3, 1;
  const Mesh mesh(x, triangles(2));
  Options o;
  o.min_separation = 0.2;
  for (const int first : {0, 3}) {  // one body, or one that turns away from what stands
    RigidTrajectory t(x);
    t.add_body(first, 6, {0, 0, 1}, {0, 0, 0.5}, {0.2, 0.2, 0});
    CHECK(compute_collision_free_stepsize(mesh, t, o).outcome == Outcome::initial_contact);
    const ActiveSet set = construct_active_set(mesh, t, o);
    REQUIRE(set.size() > 0);
    for (const Contact& c : set)
      CHECK((c.outcome == PairOutcome::initial_contact && c.toi == 0 && c.step_limit == 0));
  }
}

TEST_CASE("a window changes no time along a trajectory, with thickness neither", "[trajectory]") {
  Random random(812);
  constexpr int kCount = 6;
  for (int scene = 0; scene < fuzz(30); ++scene) {
    MatrixXd x(3 * (kCount + 1), 3);
    x.topRows(3) << -100, -100, 0, 200, -100, 0, -100, 200, 0;
    for (int k = 1; k <= kCount; ++k) {
      const double radius = std::pow(10, uniform(random, -2, 0)), height = uniform(random, 0.2, 0.7);
      x.middleRows(3 * k, 3) << 5 * k + radius, 0, height, 5 * k + radius + 0.1, 0, height + 1,
          5 * k + radius, 0.1, height + 1;
    }
    RigidTrajectory t(x);
    for (int k = 1; k <= kCount; ++k)
      t.add_body(3 * k, 3 * k + 3, any(random, 1).transpose(), {0, 0, -1}, {5.0 * k, 0, 0});
    CollisionRules rules;
    for (Eigen::Index v = 0; v < x.rows(); ++v) rules.thickness.push_back(uniform(random, 0, 0.01));
    const Mesh mesh(x, triangles(kCount + 1), rules);
    const ActiveSet all = construct_active_set(mesh, t);
    std::map<std::array<int, 3>, double> toi;
    for (const Contact& c : all) toi[{int(c.kind), c.a, c.b}] = c.toi;
    for (const double window : {0.0, 0.01, 0.05, 0.2}) {
      Options o;
      o.window = window;
      for (const Contact& c : construct_active_set(mesh, t, o))
        REQUIRE(toi.at({int(c.kind), c.a, c.b}) == c.toi);
    }
  }
}

TEST_CASE("thickness costs a trajectory no checks", "[trajectory]") {
  MatrixXd x(6, 3);
  x << -50, -50, 0, 150, -50, 0, -50, 150, 0, 1, 0, 1e-10, 1, 0.02, 1, 1, -0.02, 1;
  x.col(0).array() += 1e6;
  std::int64_t checks[2];
  for (const int thick : {0, 1}) {
    MatrixXd at = x;
    CollisionRules rules;
    if (thick == 1) rules.thickness.assign(6, 0.125), at.col(2).tail(3).array() += 0.25;
    RigidTrajectory t(at);
    t.add_body(3, 6, {0, 0, 1}, {0, 0, 0}, {1e6, 0, 0});
    checks[thick] = compute_collision_free_stepsize(Mesh(at, triangles(2), rules), t).stats.checks;
  }
  CAPTURE(checks[0], checks[1]);
  CHECK(checks[1] <= 2 * checks[0]);
}

TEST_CASE("what blocks a trajectory at the start is not hidden by a linear pair that is close",
          "[trajectory]") {
  MatrixXd x(12, 3), x1;
  x << 0, 0, 0, 1, 0, 0, 0, 1, 0, .2, .2, 1e-16, .3, .2, 1, .2, .3, 1,  // linear, and part
      10, 0, 0, 11, 0, 0, 10, 1, 0, 10.2, .2, 0, 10.3, .2, 1, 10.2, .3, 1;
  x.leftCols(2).array() += 1. / 3;
  x1 = x;
  x1.middleRows(3, 3).col(2).array() += 1, x1(3, 0) += 0.1;
  const Mesh mesh(x, triangles(4));
  CHECK(
      compute_collision_free_stepsize(Mesh(6, triangles(2)), MatrixXd(x.topRows(6)), MatrixXd(x1.topRows(6)))
          .shortest > 0);
  for (const double gap : {0.0, 1e-15, 3e-15, 1e-14, 2e-14, 4e-14, 1e-13}) {
    for (const bool within : {true, false}) {
      MatrixXd at = x;
      at.col(2).tail(3).array() += gap;
      RigidTrajectory t(at, x1);
      t.add_body(within ? 6 : 9, 12, {0, 0, 1}, {0, 0, within ? 0. : -1.}, at.row(9).transpose());
      const StepResult r = compute_collision_free_stepsize(mesh, t);
      CAPTURE(gap, within, r.step, r.shortest, int(r.outcome));
      CHECK(r.shortest <= r.step);
      if (gap == 0) CHECK((r.step == 0 && r.outcome == Outcome::initial_contact && r.limiting->a == 9));
    }
  }
}

TEST_CASE("a step of 0 along a trajectory says whether anything touches", "[trajectory]") {
  Random random(4712);
  int zero = 0;
  for (int i = 0; i < fuzz(300); ++i) {  // a linear pair, one within a body, and one of a body and a triangle
    MatrixXd x(18, 3), x1;
    double gap[3];
    for (int k = 0; k < 3; ++k) {
      gap[k] = uniform(random, 0, 5) < 1 ? 0 : std::pow(10, uniform(random, -18, -12));
      x.middleRows(6 * k, 6) << 0, 0, 0, 1, 0, 0, 0, 1, 0, .2, .2, gap[k], .3, .2, 1, .2, .3, 1;
      x.middleRows(6 * k, 6).col(0).array() += 10 * k + 1. / 3;
    }
    x1 = x;
    x1.middleRows(3, 3).col(2).array() += uniform(random, -1, 1);
    x1(3, 0) += uniform(random, -0.1, 0.1);
    RigidTrajectory t(x, x1);
    t.add_body(6, 12, any(random, 1).transpose(), any(random, 1).transpose(), any(random, 9).transpose());
    t.add_body(15, 18, any(random, 1).transpose(), any(random, 1).transpose(), any(random, 9).transpose());
    Options o;
    if (scenes::coin(random)) o.max_checks = int(uniform(random, 1, 5));
    const StepResult r = compute_collision_free_stepsize(Mesh(x, triangles(6)), t, o);
    CAPTURE(i, gap[0], gap[1], gap[2], o.max_checks, r.step, r.shortest, r.toi, int(r.outcome));
    REQUIRE((r.shortest <= r.step && r.step <= r.toi));
    zero += r.step == 0;
    if (r.step == 0) REQUIRE((r.outcome == Outcome::initial_contact || r.outcome == Outcome::below_rounding));
    if (r.step > 0) REQUIRE((r.outcome != Outcome::initial_contact));
    const bool touches = gap[0] == 0 || gap[1] == 0 || gap[2] == 0;
    if (o.max_checks > 1000) REQUIRE((r.outcome == Outcome::initial_contact) == touches);
    if (touches) REQUIRE(r.step == 0);
  }
  CHECK(zero > fuzz(100));
}

TEST_CASE("what rounding makes later of a trajectory holds no pair at the start", "[trajectory]") {
  MatrixXd x(6, 3);
  x << 0, 0, 0, 1, 0, 0, 0, 1, 0, .2, .2, 0, .3, .2, 1, .2, .3, 1;
  for (const double turns : {1e-300, 1e-12, 1e-7, 1e-3, 1.0})
    for (const double way :
         {1., 1e4, 1e8})  // its rounding is 5u of itself in the end, at the start that of x
      for (const double gap : {1e-14, 1e-12, 1e-10}) {
        MatrixXd at = x;
        at(3, 2) = gap;
        RigidTrajectory t(at);
        t.add_body(0, 3, {0, 0, turns}, {way, 0, 0}, {0, 0, 0});
        t.add_body(3, 6, {0, 0, turns}, {way, 0, 1e-6 * way}, {0, 0, 0});
        const StepResult r = compute_collision_free_stepsize(Mesh(at, triangles(2)), t);
        CAPTURE(turns, way, gap, r.step, int(r.outcome), r.stats.checks);
        CHECK(r.step > 0);
        if (turns < 1e-6) CHECK(r.step == 1);  // else the tolerance may end it
        CHECK(r.stats.checks < 20000);
      }
}

TEST_CASE("planes are counted as such where nothing turns", "[trajectory]") {
  MatrixXd x(3, 3), down(3, 3);
  x << 0, 0, 1, 1, 0, 1, 0, 1, 1;
  down = x;
  down.col(2).array() -= 2;
  CollisionRules rules;
  rules.planes = {{{0, 0, 1}, 0}};
  const ActiveSet set = construct_active_set(Mesh(x, triangles(1), rules), RigidTrajectory(x, down));
  CHECK((set.stats.contacts.vertex_plane == 3 && set.stats.contacts.edge_edge == 0));
}

}  // namespace onset::tests
