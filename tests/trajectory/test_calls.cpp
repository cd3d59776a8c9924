// Calls on trajectories: what they promise beyond times.
#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <onset/onset.hpp>

#include "tests/catch.hpp"
#include "tests/fuzz.hpp"
#include "tests/scenes/meshes.hpp"
#include "tests/src/support/answer.hpp"

namespace onset::tests {
namespace {

constexpr double kPi = 3.14159265358979323846, kNaN = std::numeric_limits<double>::quiet_NaN();

// A sphere above a cube, of `n` vertices in front; it turns.
struct Falling {
  scenes::Scene scene = scenes::sphere_onto_cube(5, 8, 0.25, 0);
  int n = 5 * 8 + 2;
  Mesh mesh{scene.x_t0, scene.faces};
  RigidTrajectory motion(const Eigen::Vector3d& rotation, const Eigen::Vector3d& translation) const {
    RigidTrajectory t(scene.x_t0);
    t.add_body(0, n, rotation, translation, centre());
    return t;
  }
  Eigen::Vector3d centre() const { return scene.x_t0.topRows(n).colwise().mean().transpose(); }
};

Answer answers(const Mesh& mesh, const Trajectory& t, const Options& o) {
  return Answer().add(compute_collision_free_stepsize(mesh, t, o), construct_active_set(mesh, t, o),
                      is_step_collision_free(mesh, t, o));
}

// A bar swings by its end as a pendulum does, with a bound from its largest acceleration: not rigid for the
// library, and not a rigid trajectory.
class Pendulum final : public Trajectory {
 public:
  Pendulum(const Eigen::MatrixXd& x, int first) : x_(x), first_(first) {}
  std::ptrdiff_t num_vertices() const override { return x_.rows(); }
  int body(std::ptrdiff_t v) const override { return v >= first_ ? kFree : kLinear; }
  void positions(double t, const int* vertices, std::size_t count, double* xyz) const override {
    for (std::size_t i = 0; i < count; ++i) {
      Eigen::Map<Eigen::Vector3d> at(xyz + 3 * i);
      at = x_.row(vertices[i]).transpose();
      if (vertices[i] >= first_ && t != 0) at = Eigen::AngleAxisd(angle(t), Eigen::Vector3d::UnitY()) * at;
    }
  }
  // |x''| <= r (angle'' + angle'^2), over eight times the square of the time between.
  void straying(double t0, double t1, const int* vertices, std::size_t count, double* bounds) const override {
    const double d = t1 - t0;
    for (std::size_t i = 0; i < count; ++i)
      bounds[i] = x_.row(vertices[i]).norm() * ((9 * kSwing + 9 * kSwing * kSwing) * d * d / 8 + 1e-14);
  }

 private:
  static constexpr double kSwing = 1;
  static double angle(double t) { return kSwing * std::sin(3 * t); }
  Eigen::MatrixXd x_;
  int first_;
};

}  // namespace

TEST_CASE("a trajectory without turning answers as the linear calls do, byte for byte", "[trajectory]") {
  scenes::Random random(5);
  for (int i = 0; i < fuzz(10); ++i) {
    const scenes::Scene s = scenes::triangle_soup(30, 0.5, 0.6, random);
    const Mesh mesh(s.x_t0, s.faces);
    RigidTrajectory t(s.x_t0, s.x_t1);
    if (i % 2 == 0) t.add_body({0, 1, 2}, {0, 0, 0}, {0.25, 0, 0.125}, {1, 2, 3});
    const Eigen::MatrixXd end = t.at(1);
    for (const double window : {0.01, 2.0}) {
      Options o;
      o.window = window;
      CHECK(answers(mesh, t, o) == Answer().add(compute_collision_free_stepsize(mesh, s.x_t0, end, o),
                                                construct_active_set(mesh, s.x_t0, end, o),
                                                is_step_collision_free(mesh, s.x_t0, end, o)));
    }
  }
}

TEST_CASE("a sphere turns in place above a cube, free, and falls on it while it turns", "[trajectory]") {
  const Falling f;
  for (const double angle : {1e-300, 1e-17, 1e-9, 0.1, 1.0, 2 * kPi, 40.0}) {
    CAPTURE(angle);
    const RigidTrajectory still = f.motion({0, 0, angle}, {0, 0, 0});
    CHECK(compute_collision_free_stepsize(f.mesh, still).step == 1);
    CHECK(is_step_collision_free(f.mesh, still));
    CHECK(construct_active_set(f.mesh, still).empty());
    // About the vertical through its pole, which falls by 0.5 with 0.25 to go.
    const RigidTrajectory falls = f.motion({0, 0, angle}, {0, 0, -0.5});
    const StepResult r = compute_collision_free_stepsize(f.mesh, falls);
    CHECK(r.outcome == Outcome::contact);
    CHECK(r.step <= 0.5);
    CHECK(r.step > 0.5 - 1e-4);
    REQUIRE(r.limiting.has_value());
    CHECK(r.limiting->kind == PairKind::vertex_face);
    const ActiveSet set = construct_active_set(f.mesh, falls);
    REQUIRE(set.earliest() != nullptr);
    CHECK(set.earliest()->toi == r.toi);
    CHECK(set.earliest()->normal[2] > 0.99);
    CHECK(std::fabs(set.earliest()->speed + 0.5) < 1e-3);
    CHECK(set.earliest()->certainty == Certainty::certain);
    CHECK(set.earliest()->toi_hi > 0.5 - 1e-9);
    CHECK(set.earliest()->toi_hi < 0.51);
  }
}

TEST_CASE("answers on trajectories scale by powers of two", "[trajectory]") {
  const Falling f;
  for (const double scale : {0x1p-900, 0x1p-300, 0x1p300, 0x1p900}) {
    CAPTURE(scale);
    RigidTrajectory t(f.scene.x_t0 * scale);
    t.add_body(0, f.n, {0.3, 1, 2}, Eigen::Vector3d(0.1, 0, -0.5) * scale, f.centre() * scale);
    RigidTrajectory plain = f.motion({0.3, 1, 2}, {0.1, 0, -0.5});
    const StepResult r = compute_collision_free_stepsize(f.mesh, t);
    const double wanted = compute_collision_free_stepsize(f.mesh, plain).step;
    CHECK(std::fabs(r.step - wanted) < 1e-5);
    CHECK(r.outcome == Outcome::contact);
  }
}

TEST_CASE("trajectories give the same bytes for any threads, broad phase and instruction set",
          "[trajectory]") {
  scenes::Random random(6);
  for (int i = 0; i < fuzz(6); ++i) {
    const scenes::Scene s = scenes::joined(scenes::triangle_soup(40, 0.4, 0.4, random), scenes::sphere(5, 7));
    const Mesh mesh(s.x_t0, s.faces);
    RigidTrajectory t(s.x_t0, s.x_t1);
    t.add_body({0, 1, 2, 3, 4, 5}, {1, 2, 3}, {0.5, 0, 0}, {0, 0, 1});
    t.add_body({6, 7, 8}, {-4, 0, 2}, {0, 0, 0}, {0, 0, 0});
    Options one;
    one.threads = 1;
    const Answer wanted = answers(mesh, t, one);
    for (const int threads : {2, 5}) {
      Options o;
      o.threads = threads;
      CHECK(answers(mesh, t, o) == wanted);
    }
    Options scalar = one;
    scalar.instruction_set = InstructionSet::scalar;
    CHECK(answers(mesh, t, scalar) == wanted);
    for (const BroadPhaseMethod method : {BroadPhaseMethod::hash, BroadPhaseMethod::brute}) {
      Options o = one;
      o.broad_phase = method;
      CHECK(answers(Mesh(s.x_t0, s.faces), t, o) == wanted);
    }
  }
}

TEST_CASE("trajectories of the caller's own: a pendulum hits a ball", "[trajectory]") {
  Eigen::MatrixXd x(4, 3);  // a point at the angle 0.5 below the pivot, and a triangle of the bar
  x << -std::sin(0.5), 0, -std::cos(0.5), 0, -0.1, 0, 0, 0.1, 0, 0, 0, -2;
  Eigen::MatrixXi face(1, 3);
  face << 1, 2, 3;
  const Mesh mesh(x, face);
  const Pendulum t(x, 1);
  const double exact = std::asin(0.5) / 3;
  const StepResult r = compute_collision_free_stepsize(mesh, t);
  CAPTURE(r.step, exact);
  CHECK(r.step <= exact);
  CHECK(r.step > exact - 1e-5);
  const ActiveSet set = construct_active_set(mesh, t);
  REQUIRE(set.size() == 1);
  CHECK(set[0].certainty == Certainty::certain);
  CHECK(set[0].toi_hi >= exact);
}

TEST_CASE("what touches at the start of a trajectory blocks it", "[trajectory]") {
  scenes::Scene s = scenes::sphere_onto_cube(5, 8, 0, 0);
  const Mesh mesh(s.x_t0, s.faces);
  RigidTrajectory t(s.x_t0);
  t.add_body(0, 42, {0, 1, 0}, {0, 0, 0.5}, {0, 0, 0});
  const StepResult r = compute_collision_free_stepsize(mesh, t);
  CHECK(r.outcome == Outcome::initial_contact);
  CHECK(r.step == 0);
  CHECK_FALSE(is_step_collision_free(mesh, t));
  CHECK(construct_active_set(mesh, t).earliest()->toi == 0);
  // Within one rigid body: two triangles at one place.
  Eigen::MatrixXd x(6, 3);
  x << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0.2, 0.2, -1, 0.2, 0.2, 1, 1, 1, 1;
  Eigen::MatrixXi faces(2, 3);
  faces << 0, 1, 2, 3, 4, 5;
  RigidTrajectory whole(x);
  whole.add_body(0, 6, {0, 0, 1}, {0, 0, 0}, {0, 0, 0});
  Options within;
  within.min_separation = 0.3;
  CHECK(compute_collision_free_stepsize(Mesh(x, faces), whole, within).outcome == Outcome::initial_contact);
  CollisionRules rigid;
  rigid.rigid_bodies = {true};
  CHECK(compute_collision_free_stepsize(Mesh(x, faces, rigid), whole, within).step == 1);
}

TEST_CASE("the smallest gaps let a trajectory begin", "[trajectory]") {
  for (const double gap : {1e-3, 1e-6, 1e-9, 1e-11, 1e-12}) {
    Falling f;
    f.scene = scenes::sphere_onto_cube(5, 8, gap, 0);
    const RigidTrajectory t = f.motion({0, 0.5, 1}, {0, 0, -0.1});
    const StepResult r = compute_collision_free_stepsize(f.mesh, t);
    CAPTURE(gap, r.step, r.rounding);
    CHECK(r.rounding < 1e-12);
    if (gap > 2 * r.rounding) CHECK(r.step > 0);
    CHECK(r.step <= gap / 0.09);
  }
}

TEST_CASE("what is not finite on a trajectory, budgets and callers are outcomes", "[trajectory]") {
  const Falling f;
  const RigidTrajectory nan = f.motion({0, kNaN, 1}, {0, 0, 0});
  const StepResult r = compute_collision_free_stepsize(f.mesh, nan);
  CHECK(r.outcome == Outcome::non_finite);
  CHECK(r.vertex == 0);
  CHECK(r.step == 0);
  CHECK(construct_active_set(f.mesh, nan).outcome == Outcome::non_finite);
  CHECK(compute_collision_free_stepsize(f.mesh, f.motion({0, 1, 0}, {0x1p1021, 0, 0})).outcome ==
        Outcome::out_of_range);
  const RigidTrajectory t = f.motion({0.3, 1, 2}, {0.1, 0, -0.5});
  Options o;
  o.time_limit = 0;
  CHECK(compute_collision_free_stepsize(f.mesh, t, o).outcome == Outcome::out_of_time);
  o = {};
  o.check_limit = 10;
  CHECK(compute_collision_free_stepsize(f.mesh, t, o).outcome == Outcome::out_of_checks);
  CHECK(construct_active_set(f.mesh, t, o).complete_until == 0);
  o = {};
  o.progress = [](double) { return false; };
  CHECK(compute_collision_free_stepsize(f.mesh, t, o).outcome == Outcome::cancelled);
  CHECK_FALSE(is_step_collision_free(f.mesh, t, o));
  o = {};
  o.memory_limit = 256;
  const ActiveSet few = construct_active_set(f.mesh, t, o);
  CHECK(few.outcome == Outcome::out_of_memory);
  CHECK(few.size() <= 1);
  for (const Contact& c : construct_active_set(f.mesh, t))
    if (c.toi < few.complete_until) CHECK(few.size() == 1);
  o = {};
  o.window = 0.01;
  const ActiveSet all = construct_active_set(f.mesh, t), early = construct_active_set(f.mesh, t, o);
  std::size_t expected = 0;
  for (const Contact& c : all) expected += c.toi <= all.earliest()->toi + 0.01;
  CHECK(early.size() == expected);
}

namespace {

// What a caller's class may get wrong.
enum class Fault { none, body, bound, position, far_away };
class Faulty final : public Trajectory {
 public:
  Faulty(const Eigen::MatrixXd& x, Fault fault) : x_(x), fault_(fault) {}
  std::ptrdiff_t num_vertices() const override { return x_.rows(); }
  int body(std::ptrdiff_t v) const override {
    return v != 3 ? kLinear : fault_ == Fault::body ? kFree - 1 : kFree;
  }
  void positions(double t, const int* vertices, std::size_t count, double* xyz) const override {
    for (std::size_t i = 0; i < count; ++i)
      for (Eigen::Index a = 0; a < 3; ++a) xyz[3 * i + std::size_t(a)] = x_(vertices[i], a);
    const bool midway = t > 0 && t < 1;
    for (std::size_t i = 0; i < count && midway; ++i) {
      if (vertices[i] == 3 && fault_ == Fault::position) xyz[3 * i] = kNaN;
      if (vertices[i] == 3 && fault_ == Fault::far_away) xyz[3 * i] = 1e308;
    }
  }
  void straying(double t0, double t1, const int*, std::size_t count, double* bounds) const override {
    for (std::size_t i = 0; i < count; ++i)
      bounds[i] = fault_ == Fault::bound ? -1 : 4 * (t1 - t0) * (t1 - t0) + 1e-15;
  }

 private:
  Eigen::MatrixXd x_;
  Fault fault_;
};

}  // namespace

TEST_CASE("what a trajectory of the caller's own gets wrong is named", "[trajectory]") {
  Eigen::MatrixXd x(6, 3);
  x << 0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, 1, 1.5, 1, 3, 1, 1.5, 3;
  Eigen::MatrixXi faces(2, 3);
  faces << 0, 1, 2, 3, 4, 5;
  const Mesh mesh(x, faces);
  CHECK(compute_collision_free_stepsize(mesh, Faulty(x, Fault::none)).outcome == Outcome::free);
  CHECK_THROWS_WITH(compute_collision_free_stepsize(mesh, Faulty(x, Fault::body)),
                    Catch::Contains("puts vertex 3 in body -3"));
  CHECK_THROWS_WITH(construct_active_set(mesh, Faulty(x, Fault::bound)),
                    Catch::Contains("straying of vertex 3 is below 0"));
  for (const Fault fault : {Fault::position, Fault::far_away}) {
    const Outcome expected = fault == Fault::position ? Outcome::non_finite : Outcome::out_of_range;
    const StepResult r = compute_collision_free_stepsize(mesh, Faulty(x, fault));
    CHECK((r.outcome == expected && r.vertex == 3 && r.step == 0));
    const ActiveSet set = construct_active_set(mesh, Faulty(x, fault));
    CHECK((set.outcome == expected && set.vertex == 3 && set.empty() && set.complete_until == 0));
    CHECK_FALSE(is_step_collision_free(mesh, Faulty(x, fault)));
  }
}

TEST_CASE("what is not for bodies that turn is refused by name, and trajectories are values",
          "[trajectory]") {
  const Falling f;
  const RigidTrajectory t = f.motion({0, 0, 1}, {0, 0, -0.5});
  const auto step = [&](const CollisionRules& rules) {
    return compute_collision_free_stepsize(Mesh(f.scene.x_t0, f.scene.faces, rules), t);
  };
  CollisionRules rules;
  rules.planes = {{{0, 0, 1}, -9}};
  CHECK_THROWS_WITH(step(rules), "planes are not supported where a vertex turns");
  rules = {};
  rules.bodies.assign(std::size_t(f.mesh.num_vertices()), 0);
  rules.body_separations = {{0, 0, 0.1}};
  CHECK_THROWS_WITH(step(rules), "body_separations are not supported where a vertex turns");
  rules = {};
  rules.rest_positions = f.scene.x_t0;
  CHECK_THROWS_WITH(step(rules), "rest_positions are not supported where a vertex turns");
  const RigidTrajectory still(Eigen::MatrixXd::Zero(2, 3));
  CHECK_THROWS_WITH(compute_collision_free_stepsize(Mesh::in_plane(2, Eigen::RowVector2i(0, 1)), still),
                    Catch::Contains("trajectories have three coordinates"));
  RigidTrajectory copy = still;
  copy = t;
  CHECK(answers(f.mesh, copy, {}) == answers(f.mesh, t, {}));
  const RigidTrajectory moved = std::move(copy);
  CHECK(answers(f.mesh, moved, {}) == answers(f.mesh, t, {}));
  RigidTrajectory out_of_range(f.scene.x_t0);
  CHECK_THROWS_AS(out_of_range.add_body(-1, 3, {0, 0, 1}, {0, 0, 0}, {0, 0, 0}), std::invalid_argument);
  CHECK_THROWS_AS(out_of_range.add_body(3, 2, {0, 0, 1}, {0, 0, 0}, {0, 0, 0}), std::invalid_argument);
  CHECK_THROWS_AS(out_of_range.add_body(0, f.mesh.num_vertices() + 1, {0, 0, 1}, {0, 0, 0}, {0, 0, 0}),
                  std::invalid_argument);
}

TEST_CASE("rules hold along trajectories", "[trajectory]") {
  const Falling f;
  const RigidTrajectory t = f.motion({0, 0, 1}, {0, 0, -0.5});
  CollisionRules rules;
  for (int v = 0; v < f.mesh.num_vertices(); ++v) rules.bodies.push_back(v >= f.n);
  rules.excluded_bodies = {{0, 1}};
  CHECK(compute_collision_free_stepsize(Mesh(f.scene.x_t0, f.scene.faces, rules), t).step == 1);
  rules.excluded_bodies.clear();
  rules.thickness.assign(rules.bodies.size(), 0.05);  // 0.1 nearer, of the 0.25
  rules.thickness[0] = 0.15;
  rules.static_vertices.assign(rules.bodies.size(), false);
  for (std::size_t v = std::size_t(f.n); v < rules.bodies.size(); ++v) rules.static_vertices[v] = true;
  const StepResult r = compute_collision_free_stepsize(Mesh(f.scene.x_t0, f.scene.faces, rules), t);
  CHECK(r.outcome != Outcome::free);
  CHECK(r.step <= 0.3);
  CHECK(r.step > 0);
  rules.static_vertices[0] = true;
  CHECK_THROWS_AS(compute_collision_free_stepsize(Mesh(f.scene.x_t0, f.scene.faces, rules), t),
                  std::invalid_argument);
  Options o;
  o.touching_may_pass_through = true;
  CHECK_THROWS_AS(construct_active_set(f.mesh, t, o), std::invalid_argument);
  CHECK_THROWS_AS(is_step_collision_free(Mesh(3, Eigen::MatrixXi(0, 3)), t), std::invalid_argument);
}

}  // namespace onset::tests
