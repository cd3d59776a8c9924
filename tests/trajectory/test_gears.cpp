// Two gears that linear motion tells wrong things about, in both directions.
#include <cstdio>
#include <onset/onset.hpp>

#include "tests/catch.hpp"
#include "tests/trajectory/dense_truth.hpp"
#include "tests/trajectory/gears.hpp"

namespace onset::tests {
namespace {

constexpr double kPi = 3.14159265358979323846;

CollisionRules rules_of(const Gears& g) {
  CollisionRules rules;
  for (Eigen::Index v = 0; v < g.scene.x_t0.rows(); ++v)
    rules.bodies.push_back(v < 2 * g.gear_vertices ? int(v) / g.gear_vertices : 2);
  rules.rigid_bodies = {true, true, true};
  return rules;
}

}  // namespace

TEST_CASE("gears that run in each other are free, and linear paths run into the axles", "[trajectory]") {
  const Gears g = gears(kPi / 3, -kPi / 3);  // two teeth
  const Mesh mesh(g.scene.x_t0, g.scene.faces, rules_of(g));
  CHECK(is_step_collision_free(mesh, g.trajectory));
  CHECK(compute_collision_free_stepsize(mesh, g.trajectory).step == 1);
  const StepResult linear = compute_collision_free_stepsize(mesh, g.scene.x_t0, g.scene.x_t1);
  CHECK(linear.outcome == Outcome::contact);
  CHECK(linear.step < 0.5);  // the bore of 0.4 shrinks to 0.38, and has corners between
  std::printf("gears that run: 1, by linear paths %.3f\n", linear.step);
}

TEST_CASE("a gear that turns against one that stands is stopped, and linear paths pass", "[trajectory]") {
  Gears g = gears(kPi, 0);
  CollisionRules rules = rules_of(g);
  rules.excluded_bodies = {{0, 2}, {1, 2}};  // without the axles: linear paths meet nothing
  const Mesh mesh(g.scene.x_t0, g.scene.faces, rules);
  const StepResult r = compute_collision_free_stepsize(mesh, g.trajectory);
  CHECK(r.outcome == Outcome::contact);
  CHECK(r.step > 0);
  CHECK(r.step < 0.1);
  CHECK(is_step_collision_free(mesh, g.scene.x_t0, g.scene.x_t1));
  const ActiveSet set = construct_active_set(mesh, g.trajectory);
  CHECK(set.earliest()->toi == r.toi);
  // The time, by samples of the pairs that the set has first.
  TurningPaths paths{g.scene.x_t0,
                     g.scene.x_t0,
                     std::vector<int>(std::size_t(g.scene.x_t0.rows()), -1),
                     {{{0, 0, kPi}, {0, 0, 0}, {0, 0, 0}}}};
  std::fill_n(paths.body.begin(), g.gear_vertices, 0);
  Long first = INFINITY;
  for (const Contact& c : set)
    if (c.toi > r.toi + 0.05)
      continue;
    else if (const Truth truth = first_contact(paths, c.kind, c.vertices, 0, 400); truth.first)
      first = std::min(first, *truth.first);
  CHECK(r.step <= double(first) + 1e-12);
  CHECK(r.step >= double(first) - 1e-4);
  std::printf("a gear against one that stands: %.6f of %.6f, by linear paths 1\n", r.step, double(first));
}

}  // namespace onset::tests
