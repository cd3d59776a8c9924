// Steps without a collision check never lead over a contact: against the full check and exact arithmetic.
#include "tests/catch.hpp"
#include "tests/narrowphase/exact/exact_pair.hpp"
#include "tests/oracle/oracle.hpp"
#include "tests/scenes/rules.hpp"
#include "tests/src/support/mesh_pairs.hpp"
#include "tests/src/support/scene_set.hpp"

using namespace onset;
using namespace onset::tests;

namespace {

// Every vertex r_i along a random direction, except that the vertices of the i-th pair run at each other.
Eigen::MatrixXd motion_within(const std::vector<double>& r, const Eigen::MatrixXd& x, const ClosePairs& close,
                              std::size_t pressed, scenes::Random& random) {
  Eigen::MatrixXd dx(x.rows(), 3);
  for (Eigen::Index v = 0; v < x.rows(); ++v) {
    Eigen::RowVector3d d;
    for (int a = 0; a < 3; ++a) d[a] = scenes::uniform(random, -1, 1);
    dx.row(v) = r[std::size_t(v)] / d.norm() * d;
  }
  if (close.size() == 0) return dx;
  const ClosePair& p = close.pairs[pressed % close.size()];
  Eigen::RowVector3d n = Eigen::RowVector3d::Zero();
  for (std::size_t i = 0; i < 4; ++i) n += p.weights[i] * x.row(p.vertices[i]);
  const int side = p.kind == PairKind::vertex_face ? 1 : 2;
  if (n.norm() > 0)
    for (int i = 0; i < 4; ++i) {
      const int v = p.vertices[std::size_t(i)];
      dx.row(v) = (i < side ? -1 : 1) * r[std::size_t(v)] * n.normalized();
    }
  return dx;
}

// The exact first contact among the pairs that the active set holds; infinite without one.
double first_contact(const Mesh& mesh, const Eigen::MatrixXd& x_t0, const Eigen::MatrixXd& x_t1) {
  double first = INFINITY;
  const ActiveSet set = construct_active_set(mesh, x_t0, x_t1);
  for (const Contact& c : set)
    first = std::min(first, oracle::exact_ccd(query_of(c.kind, c.vertices, x_t0, x_t1)).toi_lo);
  return first;
}

}  // namespace

TEST_CASE("motion within the safe distances makes no contact", "[oracle][property]") {
  scenes::Random random(2);
  std::size_t pressed_hard = 0;
  for (const NamedScene& named : some_scenes())
    for (const double d_hat : {0.004, 0.1})
      for (std::size_t trial = 0; trial < 12; ++trial) {
        CAPTURE(named.name, d_hat, trial);
        const Mesh mesh = named.mesh();
        const Eigen::MatrixXd& x = named.scene.x_t0;
        const ClosePairs close = close_pairs(mesh, x, d_hat);
        const std::vector<double> r = safe_distances(mesh, x, close);
        const Eigen::MatrixXd dx = motion_within(r, x, close, trial * 7919, random);
        const Eigen::MatrixXd there = x + dx;
        for (std::size_t v = 0; v < r.size(); ++v) CHECK(r[v] <= d_hat / 2);
        Options conservative;  // near misses are reported
        conservative.exactness = Exactness::conservative;
        // Pairs that touch from the start have r = 0 and stay as they are.
        const ActiveSet set = construct_active_set(mesh, x, there, conservative);
        for (const Contact& c : set) {
          const scenes::Query q = query_of(c.kind, c.vertices, x, there);
          if (c.outcome == PairOutcome::initial_contact || c.outcome == PairOutcome::initial_separating)
            continue;
          ++pressed_hard;
          CHECK_FALSE(oracle::exact_ccd(q).collides);
        }
        const bool touching = !set.empty() && set.earliest()->toi == 0;
        if (!touching) CHECK(is_step_collision_free(mesh, x, x + 0.99 * dx));
      }
  CHECK(pressed_hard > 0);  // some came within the tolerance, and exact arithmetic still saw no contact
}

TEST_CASE("the safe step scales every vertex into its distance", "[unit]") {
  Eigen::MatrixXd dx(2, 3);
  dx << 3, 0, 4, 0, 0.5, 0;
  CHECK(safe_step({10, 1}, dx) == 1);
  CHECK(safe_step({1, 1}, dx) <= 0.2);
  CHECK(safe_step({1, 1}, dx) > 0.2 * (1 - 1e-12));
  CHECK(safe_step({10, 0}, dx) == 0);
  dx(0, 1) = NAN;
  CHECK(safe_step({10, 10}, dx) == 0);
  CHECK_THROWS_AS(safe_step({1}, dx), std::invalid_argument);
  CHECK(safe_step({NAN, 10}, Eigen::MatrixXd::Zero(2, 3)) == 0);
  CHECK(safe_step({-1, 10}, Eigen::MatrixXd::Ones(2, 3)) == 0);
}

TEST_CASE("the safe step is rounded down where it is subnormal", "[unit]") {
  Eigen::MatrixXd dx = Eigen::MatrixXd::Zero(1, 3);
  dx(0, 0) = 0x1p1014;
  for (const double r : {0x1.8p-61, 0x1p-60, 0x1.8p-59, 0x1.4p-55, 0x1p-30}) {
    const double step = safe_step({r}, dx);
    CAPTURE(r, step);
    CHECK(step * 0x1p1014 <= r);  // exactly: a power of two
    if (r > 0x1p-50) CHECK(step > 0);
  }
}

TEST_CASE("a step by gaps of subnormal share stays apart", "[unit]") {
  // A vertex and a face that move towards each other by 2^1013 each, and next to no gap between them.
  Eigen::MatrixXd x_t0(4, 3), x_t1;
  const double gap = 0x1.e4p-60;
  x_t0 << 0x1p-62, 0x1p-62, gap, -0x1p-60, -0x1p-60, 0, 0x1p-60, -0x1p-60, 0, 0, 0x1p-60, 0;
  x_t1 = x_t0;
  x_t1(0, 2) -= 0x1p1013;
  x_t1.bottomRows(3).col(2).array() += 0x1p1013;
  Eigen::MatrixXi faces(1, 3);
  faces << 1, 2, 3;
  const Mesh mesh(x_t0, faces);
  Options none;
  none.time_limit = 0;
  for (const double share : {0.0, 0.2, 0.9}) {
    const ClosePairs close = close_pairs(mesh, x_t0, 0x1p-58);
    REQUIRE(close.size() > 0);
    const StepResult r = compute_cfl_stepsize(mesh, x_t0, x_t1, close, none, share);
    CAPTURE(share, r.step);
    CHECK(r.step * 0x1p1014 < gap);
  }
}

TEST_CASE("the CFL step is never later than the exact first contact", "[oracle][property]") {
  for (const NamedScene& named : some_scenes())
    for (const double d_hat : {1e-3, 0.05, 0.5})
      for (const double scale : {0.05, 1.0}) {
        CAPTURE(named.name, d_hat, scale);
        const Mesh mesh = named.mesh();
        const Eigen::MatrixXd &x = named.scene.x_t0, there = x + scale * (named.scene.x_t1 - x);
        const StepResult r = compute_cfl_stepsize(mesh, x, there, close_pairs(mesh, x, d_hat), {}, 0);
        CHECK(r.step <= first_contact(mesh, x, there));
        const double moved = (there - x).rowwise().norm().maxCoeff();
        CHECK(r.step <= (moved > 0 ? d_hat / (2 * moved) : 1));
        if (r.outcome == Outcome::free) CHECK(r.step >= std::min(1.0, 0.999 * d_hat / (2 * moved + 1e-300)));
      }
}

TEST_CASE("a CFL step out of time is the one that the distances allow", "[oracle][property]") {
  int longer = 0;
  for (const NamedScene& named : some_scenes())
    for (const double d_hat : {0.05, 0.5}) {
      CAPTURE(named.name, d_hat);
      const Mesh mesh = named.mesh();
      const Eigen::MatrixXd &x = named.scene.x_t0, &there = named.scene.x_t1;
      const ClosePairs close = close_pairs(mesh, x, d_hat);
      if (close.size() == 0) continue;  // nothing to run out of time for
      Options o;
      o.time_limit = 0;
      const StepResult r = compute_cfl_stepsize(mesh, x, there, close, o, 0);
      const double by_gaps = safe_step(safe_distances(mesh, x, close), there - x);
      CHECK(r.step == by_gaps);
      CHECK((r.step <= first_contact(mesh, x, there) && !r.limiting));
      CHECK(r.outcome == (r.step < 1 ? Outcome::out_of_time : Outcome::free));
      CHECK(r.toi == (r.step < 1 ? r.step : INFINITY));
      longer += r.step > 0;
    }
  CHECK(longer > 4);
}

// The classic mistake: no pair is near, so the step is declared free.
TEST_CASE("a fast triangle far from another is stopped by the bound", "[unit]") {
  Eigen::MatrixXd x(6, 3), there;
  x << 0, 0, 0, 1, 0, 0, 0, 1, 0, .2, .2, .5, 1.2, .2, .6, .2, 1.2, .7;
  Eigen::MatrixXi F(2, 3);
  F << 0, 1, 2, 3, 4, 5;
  const Mesh mesh(x, F);
  there = x;
  there.col(2).tail(3).array() -= 1;
  const ClosePairs close = close_pairs(mesh, x, 0.01);
  REQUIRE(close.size() == 0);
  const StepResult r = compute_cfl_stepsize(mesh, x, there, close, {}, 0);
  CHECK(r.step <= 0.005);
  CHECK(r.step > 0.0049);
  CHECK(r.outcome == Outcome::free);
  CHECK_FALSE(r.limiting);
  const StepResult wide = compute_cfl_stepsize(mesh, x, there, close_pairs(mesh, x, 4), {}, 0);
  CHECK(wide.outcome == Outcome::contact);
  CHECK(wide.step == compute_collision_free_stepsize(mesh, x, there).step);
}

TEST_CASE("far from the origin safe distances leave room for rounding", "[unit]") {
  scenes::Scene scene = scenes::translated(some_scenes()[5].scene, {1e12, 0, 0});
  const Mesh mesh(scene.x_t0, scene.faces);
  const ClosePairs close = close_pairs(mesh, scene.x_t0, 1e-3);
  for (const double r : safe_distances(mesh, scene.x_t0, close)) CHECK(r <= 5e-4 - 1e12 * 0x1p-52);
  CHECK(safe_distances(mesh, scene.x_t0, close_pairs(mesh, scene.x_t0, 1e-4))[0] == 0);
}

TEST_CASE("close pairs of another mesh are rejected", "[unit]") {
  const NamedScene a = some_scenes()[3], b = some_scenes()[5];
  const ClosePairs close = close_pairs(b.mesh(), b.scene.x_t0, 0.2);
  REQUIRE(close.size() > 0);
  CHECK_THROWS_AS(safe_distances(a.mesh(), a.scene.x_t0, close), std::invalid_argument);
  CHECK_THROWS_AS(compute_cfl_stepsize(a.mesh(), a.scene.x_t0, a.scene.x_t1, close), std::invalid_argument);
  CHECK_THROWS_AS(safe_distances(b.mesh(), b.scene.x_t0, ClosePairs{}), std::invalid_argument);
  CHECK_THROWS_AS(safe_distances(b.mesh(), b.scene.x_t0.leftCols(2), close), std::invalid_argument);
  ClosePairs wrong = close;
  wrong.outcome = Outcome::out_of_time;
  CHECK_THROWS_WITH(safe_distances(b.mesh(), b.scene.x_t0, wrong),
                    "the close pairs have the outcome out_of_time");
  const ClosePair first = close.pairs.front();
  const bool face = first.kind == PairKind::vertex_face;
  const int firsts = int(face ? b.mesh().num_vertices() : b.mesh().num_edges()),
            seconds = int(face ? b.mesh().num_faces() : b.mesh().num_edges());
  for (const auto& [pair_a, pair_b] :
       {std::pair{-1, first.b}, {firsts, first.b}, {first.a, -1}, {first.a, seconds}}) {
    wrong = close;
    wrong.pairs.front().a = pair_a, wrong.pairs.front().b = pair_b;
    CHECK_THROWS_WITH(safe_distances(b.mesh(), b.scene.x_t0, wrong),
                      "close pair 0 is not a pair of this mesh");
  }
}

TEST_CASE("a CFL step minds the rules of its mesh, and what is not finite", "[unit]") {
  Eigen::MatrixXd x(6, 3);
  x << 0, 0, 0, 1, 0, 0, 0, 1, 0, .2, .2, .5, 1.2, .2, .6, .2, 1.2, .7;
  Mesh mesh(x, Eigen::MatrixXi((Eigen::MatrixXi(2, 3) << 0, 1, 2, 3, 4, 5).finished()));
  Eigen::MatrixXd there = x;
  there.col(2).tail(3).array() -= 1;
  const ClosePairs close = close_pairs(mesh, x, 4);
  REQUIRE(compute_cfl_stepsize(mesh, x, there, close).outcome == Outcome::contact);
  Eigen::MatrixXd nowhere = there;
  nowhere(4, 1) = NAN;
  const StepResult lost = compute_cfl_stepsize(mesh, x, nowhere, close);
  CHECK((lost.outcome == Outcome::non_finite && lost.vertex == 4 && lost.step == 0));
  CHECK(safe_step(safe_distances(mesh, x, close), nowhere - x) == 0);
  scenes::set_rule(mesh, &CollisionRules::bodies, {0, 0, 0, 1, 1, 1});
  scenes::set_rule(mesh, &CollisionRules::excluded_bodies, {{0, 1}});
  const StepResult free = compute_cfl_stepsize(mesh, x, there, close);
  CHECK((free.outcome == Outcome::free && free.step == 1));
}
