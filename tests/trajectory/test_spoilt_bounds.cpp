// A trajectory of the caller's own whose bounds or positions are wrong here and there: no answer is made of
// those.
#include <Eigen/Geometry>
#include <atomic>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <onset/onset.hpp>

#include "tests/catch.hpp"
#include "tests/fuzz.hpp"
#include "tests/scenes/random.hpp"
#include "tests/scenes/triangles.hpp"
#include "tests/src/support/answer.hpp"

namespace onset::tests {
namespace {

using Eigen::MatrixXd;
using scenes::Random;
using scenes::triangles;
using scenes::uniform;
using Where = std::function<bool(double t0, double t1, int vertex)>;

// Answers as another one does, but that bounds, or positions on the way, are `wrong` of some vertices at some
// times.
class Spoilt final : public Trajectory {
 public:
  enum class What { bounds, positions };
  Spoilt(const Trajectory& good, What what, double wrong, Where where)
      : good_(good), what_(what), wrong_(wrong), where_(where) {}
  std::ptrdiff_t num_vertices() const override { return good_.num_vertices(); }
  int body(std::ptrdiff_t v) const override { return good_.body(v); }
  void positions(double t, const int* vertices, std::size_t count, double* xyz) const override {
    good_.positions(t, vertices, count, xyz);
    for (std::size_t i = 0; i < count; ++i)
      if (what_ == What::positions && t > 0 && t < 1 && where_(t, t, vertices[i]))
        xyz[3 * i + 1] = wrong_, used_ = true;
  }
  void straying(double t0, double t1, const int* vertices, std::size_t count, double* bounds) const override {
    good_.straying(t0, t1, vertices, count, bounds);
    for (std::size_t i = 0; i < count; ++i)
      if (what_ == What::bounds && where_(t0, t1, vertices[i])) bounds[i] = wrong_, used_ = true;
  }
  bool was_used() const { return used_; }

 private:
  const Trajectory& good_;
  const What what_;
  const double wrong_;
  const Where where_;
  mutable std::atomic<bool> used_{false};
};

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kWrong[] = {-1, -0x1p-1074, -INFINITY, kNaN, INFINITY, 0x1p1021};

Outcome expected(double wrong) { return std::isfinite(wrong) ? Outcome::out_of_range : Outcome::non_finite; }

// Asks for a step, an active set and whether the step is free. Whatever is wrong is refused; where nothing
// was, the answers are those of `good`. Returns how often it was refused.
int refused(const Mesh& mesh, const Trajectory& good, Spoilt::What what, double wrong, const Where& where,
            const Options& o) {
  int count = 0;
  for (int call = 0; call < 3; ++call) {
    const Spoilt t(good, what, wrong, where);
    Outcome outcome{};
    int vertex = -1;
    bool thrown = false, same = false;
    try {
      if (call == 0) {
        const StepResult r = compute_collision_free_stepsize(mesh, t, o);
        outcome = r.outcome, vertex = r.vertex;
        if (vertex >= 0) CHECK((r.step == 0 && r.shortest == 0));
        same = Answer().add(r) == Answer().add(compute_collision_free_stepsize(mesh, good, o));
      } else if (call == 1) {
        const ActiveSet set = construct_active_set(mesh, t, o);
        outcome = set.outcome, vertex = set.vertex;
        if (vertex >= 0) CHECK((set.empty() && set.complete_until == 0));
        same = Answer().add(set) == Answer().add(construct_active_set(mesh, good, o));
      } else {
        same = is_step_collision_free(mesh, t, o) == is_step_collision_free(mesh, good, o);
        if (t.was_used() && !(wrong < 0)) same = !is_step_collision_free(mesh, t, o);
      }
    } catch (const std::invalid_argument& e) {
      CHECK(std::strstr(e.what(), "bound of straying of vertex") != nullptr);
      thrown = true;
    }
    CAPTURE(wrong, call, int(outcome), vertex, thrown);
    if (!t.was_used()) {
      REQUIRE(same);
      continue;
    }
    ++count;
    REQUIRE(thrown == (wrong < 0));
    if (!thrown && call < 2) REQUIRE((outcome == expected(wrong) && vertex >= 0));
    if (!thrown && call == 2) REQUIRE(same);
  }
  return count;
}

// Triangles that may meet.
MatrixXd triangles_at(Random& random, int count) {
  MatrixXd x(3 * count, 3);
  for (int k = 0; k < count; ++k) {
    const Eigen::RowVector3d at(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
    for (int v = 0; v < 3; ++v)
      for (int a = 0; a < 3; ++a) x(3 * k + v, a) = at[a] + uniform(random, -0.4, 0.4);
  }
  return x;
}

}  // namespace

TEST_CASE("a bound at rest that is no bound is refused, also of a body that is alone", "[trajectory]") {
  MatrixXd x(6, 3);
  x << 0, 0, 0, 1, 0, 0, 0, 1, 0, .2, .2, 1e-17, .3, .2, 1, .2, .3, 1;
  const Mesh mesh(x, triangles(2));
  RigidTrajectory t(x);
  t.add_body(0, 6, {.1, .3, .2}, {3, 1, 2}, {0, 0, 0});
  const auto at_rest = [](double t0, double t1, int) { return t0 == t1; };
  for (const double wrong : kWrong) CHECK(refused(mesh, t, Spoilt::What::bounds, wrong, at_rest, {}) == 3);
}

TEST_CASE("a bound of 0 at the start alone costs no checks", "[trajectory]") {
  MatrixXd x(6, 3);
  x << 0, 0, 0, 1, 0, 0, 0, 1, 0, .2, .2, 1e-17, .3, .2, 1, .2, .3, 1;
  const Mesh mesh(x, triangles(2));
  RigidTrajectory good(x);
  good.add_body(3, 6, {.1, .3, .2}, {3, 1, 2}, {0, 0, 0});
  const Spoilt t(good, Spoilt::What::bounds, 0, [](double, double t1, int) { return t1 == 0; });
  const StepResult r = compute_collision_free_stepsize(mesh, t);
  CHECK(r.outcome == Outcome::below_rounding);
  CHECK(r.stats.checks <= compute_collision_free_stepsize(mesh, good).stats.checks);
}

TEST_CASE("no answer is made of bounds that are none, whenever they are asked for", "[trajectory]") {
  Random random(4711);
  int count = 0, of_positions = 0;
  for (int scene = 0; scene < fuzz(60); ++scene) {
    const int bodies = 5;
    const MatrixXd x = triangles_at(random, bodies);
    MatrixXd x1 = x;
    for (Eigen::Index v = 0; v < x.rows(); ++v) x1(v, 0) += uniform(random, -0.5, 0.5);
    const Mesh mesh(x, triangles(bodies));
    if (has_intersections(mesh, x)) continue;
    RigidTrajectory t(x, x1);
    const auto any = [&](double size) {
      return Eigen::Vector3d(uniform(random, -size, size), uniform(random, -size, size),
                             uniform(random, -size, size));
    };
    t.add_body(0, 6, any(2), any(0.7), any(1));
    t.add_body(6, 9, any(2), any(0.7), any(1));
    Options o;
    if (scenes::coin(random)) o.min_separation = uniform(random, 0, 0.05);
    if (scenes::coin(random)) o.exactness = Exactness::exact;
    const std::uint64_t salt = random();
    const int often = 1 + int(uniform(random, 0, 6));
    const bool at_rest = scenes::coin(random);
    const Where where = [=](double t0, double t1, int v) {  // a few, the same ones each time
      if (at_rest && t0 != t1) return false;
      std::uint64_t bits[2];
      std::memcpy(&bits[0], &t0, 8), std::memcpy(&bits[1], &t1, 8);
      std::uint64_t h = salt ^ std::uint64_t(v);
      for (const std::uint64_t b : bits) h = (h ^ b) * 0x9e3779b97f4a7c15u, h ^= h >> 29;
      return h % (1u << often) == 0;
    };
    count += refused(mesh, t, Spoilt::What::bounds, kWrong[std::size_t(scene) % 6], where, o);
    of_positions += refused(mesh, t, Spoilt::What::positions, kWrong[3 + std::size_t(scene) % 3], where, o);
  }
  CHECK((count > fuzz(60) && of_positions > fuzz(60)));
}

}  // namespace onset::tests
