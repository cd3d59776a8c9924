// The scenes of the tests of nonlinear motion in ipc-toolkit, whose times are known: its calls answer within
// 1e-2 of them.
#include <onset/onset.hpp>

#include "tests/catch.hpp"

namespace onset::tests {
namespace {

constexpr double kPi = 3.14159265358979323846;

struct Turned {
  Mesh mesh;
  RigidTrajectory trajectory;
};

// Vertices [first, last) turn about the z axis by `angle`; points are declared.
Turned scene(const Eigen::MatrixXd& x, const Eigen::MatrixXi& edges, const Eigen::MatrixXi& faces, int first,
             int last, double angle, const std::vector<int>& points) {
  CollisionRules rules;
  rules.points = points;
  Turned r{Mesh(x, complete_edges(edges, faces), faces, rules), RigidTrajectory(x)};
  r.trajectory.add_body(first, last, {0, 0, angle}, {0, 0, 0}, {0, 0, 0});
  return r;
}

// Never later than the exact time, and no earlier than `least`.
void check(const Turned& s, double least, double exact) {
  const StepResult r = compute_collision_free_stepsize(s.mesh, s.trajectory);
  CAPTURE(least, exact, r.step);
  CHECK(r.outcome == Outcome::contact);
  CHECK(r.step <= exact);
  CHECK(r.step >= least - 5e-6);
  CHECK(r.toi == r.step);
  CHECK_FALSE(is_step_collision_free(s.mesh, s.trajectory));
  const ActiveSet set = construct_active_set(s.mesh, s.trajectory);
  REQUIRE(set.earliest() != nullptr);
  CHECK(set.earliest()->toi == r.toi);
  std::printf("nonlinear scene: %.9f of %.9f\n", r.step, exact);
}

}  // namespace

TEST_CASE("times of a point and a point, a point and an edge, two edges, a point and a face",
          "[trajectory]") {
  const Eigen::MatrixXi no_edges(0, 2), no_faces(0, 3);
  Eigen::MatrixXi edge(1, 2), edges(2, 2), face(1, 3);
  edge << 1, 2;
  edges << 0, 1, 2, 3;
  face << 0, 1, 2;
  Eigen::MatrixXd x(2, 3);
  x << 0, 1, 0, 1, 0, 0;
  check(scene(x, no_edges, no_faces, 1, 2, kPi, {0, 1}), 0.499996, 0.5);
  x.resize(3, 3);
  x << 0, 0.5, 0, -1, 0, 0, 1, 0, 0;
  check(scene(x, edge, no_faces, 1, 3, 2 * kPi, {0}), 0.249986, 0.25);
  check(scene(x, edge, no_faces, 1, 3, kPi, {0}), 0.499988, 0.5);
  x.resize(4, 3);
  x << -1, 0, 0, 1, 0, 0, -1, 0.5, 0, 1, 0.5, 0;
  check(scene(x, edges, no_faces, 0, 2, 2 * kPi, {}), 0.083326, 30 / 360.0);
  for (const double at : {-0.1, 0.0, 0.1}) {
    x << 1, 0, 0, at, 0, 1, at, 0, -1, 0, 0.5, 0;
    check(scene(x, no_edges, face, 0, 3, kPi, {}), 0.499988, 0.5);
  }
}

}  // namespace onset::tests
