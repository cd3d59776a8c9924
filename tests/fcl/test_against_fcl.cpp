// A body moves into another, both generated, turned at random and one of them deforming. FCL, which knows
// nothing of the motion, must find them apart after the step that the pipeline allows, and meeting after a
// slightly longer one.
#include <Eigen/Geometry>

#include "onset/step_size.hpp"
#include "tests/catch.hpp"
#include "tests/fcl/bodies.hpp"
#include "tests/scenes/meshes.hpp"

using namespace onset;
using namespace onset::scenes;

namespace {

struct TwoBodies {
  Scene scene;
  int second_body = 0;  // its first vertex

  Eigen::MatrixXd at(double t) const { return scene.x_t0 + t * (scene.x_t1 - scene.x_t0); }
  bool meet(double t) const { return fcl_test::intersect(at(t), scene.faces, second_body); }
  double gap(double t) const { return fcl_test::distance(at(t), scene.faces, second_body); }
};

Eigen::Matrix3d random_turn(Random& random) {
  Eigen::Vector4d q;
  do
    for (double& c : q) c = uniform(random, -1, 1);
  while (q.norm() > 1 || q.norm() < 0.1);
  return Eigen::Quaterniond(q.normalized()).toRotationMatrix();
}

void turn(Scene& scene, const Eigen::Matrix3d& by) {
  scene.x_t0 = (scene.x_t0 * by.transpose()).eval();
  scene.x_t1 = (scene.x_t1 * by.transpose()).eval();
}

// A cube or a sphere at rest; a sphere at a distance of 0.05 to 0.3 from its bounding sphere that moves
// through it, its vertices displaced besides by up to `noise`; all of it turned.
TwoBodies approach(std::uint64_t seed, double noise) {
  Random random(seed);
  const bool is_cube = coin(random);
  Scene target = is_cube ? cube() : sphere(9, 16);
  turn(target, random_turn(random));
  Scene ball = sphere(7, 12);
  turn(ball, random_turn(random));
  const double radius = is_cube ? std::sqrt(3.0) : 1;
  ball = translated(ball, {radius + 1 + uniform(random, 0.05, 0.3), uniform(random, -0.3, 0.3), 0});
  displace(ball, {-2, uniform(random, -0.2, 0.2), uniform(random, -0.2, 0.2)});
  shake(ball, noise, random);
  Scene scene = joined(ball, target);
  turn(scene, random_turn(random));
  return {scene, int(ball.x_t0.rows())};
}

}  // namespace

TEST_CASE("FCL finds no intersection after the step and one after a step a little longer", "[oracle][fcl]") {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const TwoBodies bodies = approach(seed, seed % 2 ? 0 : 0.05);
    const Mesh mesh(bodies.scene.x_t0, bodies.scene.faces);
    CAPTURE(seed);
    REQUIRE_FALSE(bodies.meet(0));
    const StepResult r = compute_collision_free_stepsize(mesh, bodies.scene.x_t0, bodies.scene.x_t1);
    REQUIRE(r.outcome == Outcome::contact);
    REQUIRE(r.step > 0);
    REQUIRE(r.step < 1);
    for (int i = 1; i <= 8; ++i) CHECK_FALSE(bodies.meet(r.step * i / 8));
    CHECK(bodies.meet(r.step + 1e-4));
    CHECK(is_step_collision_free(mesh, bodies.scene.x_t0, bodies.at(0.999 * r.step)));
    CHECK_FALSE(is_step_collision_free(mesh, bodies.scene.x_t0, bodies.at(r.step + 1e-4)));
  }
}

TEST_CASE("FCL measures the minimum separation after the step, and less after a longer one",
          "[oracle][fcl]") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const TwoBodies bodies = approach(seed, seed % 2 ? 0 : 0.05);
    const Mesh mesh(bodies.scene.x_t0, bodies.scene.faces);
    Options options;
    options.min_separation = 0.01;
    CAPTURE(seed);
    REQUIRE(bodies.gap(0) > options.min_separation);
    const StepResult r = compute_collision_free_stepsize(mesh, bodies.scene.x_t0, bodies.scene.x_t1, options);
    REQUIRE(r.outcome == Outcome::contact);
    REQUIRE(r.step > 0);
    for (int i = 1; i <= 4; ++i) CHECK(bodies.gap(r.step * i / 4) > options.min_separation * (1 - 1e-9));
    CHECK(bodies.gap(r.step + 1e-4) < options.min_separation);
  }
}

TEST_CASE("FCL finds no intersection anywhere on a step that is free", "[oracle][fcl]") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    TwoBodies bodies = approach(seed, 0.02);
    const auto n = bodies.second_body;
    // The ball passes by: its motion is replaced by one across the line to the target.
    const Eigen::RowVector3d to_target =
        bodies.scene.x_t0.bottomRows(bodies.scene.x_t0.rows() - n).colwise().mean() -
        bodies.scene.x_t0.topRows(n).colwise().mean();
    const Eigen::RowVector3d across = to_target.cross(Eigen::RowVector3d(0.3, 0.5, 0.7)).normalized();
    bodies.scene.x_t1.topRows(n) = bodies.scene.x_t0.topRows(n).rowwise() + 2 * across;
    const Mesh mesh(bodies.scene.x_t0, bodies.scene.faces);
    CAPTURE(seed);
    const StepResult r = compute_collision_free_stepsize(mesh, bodies.scene.x_t0, bodies.scene.x_t1);
    CHECK(r.outcome == Outcome::free);
    CHECK(r.step == 1);
    for (int i = 0; i <= 8; ++i) CHECK_FALSE(bodies.meet(i / 8.0));
  }
}
