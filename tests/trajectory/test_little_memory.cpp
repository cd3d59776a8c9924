// Trajectories with a memory_limit: what does not fit is said to be missing.
#include <algorithm>
#include <cmath>
#include <onset/onset.hpp>

#include "tests/catch.hpp"
#include "tests/fuzz.hpp"
#include "tests/scenes/random.hpp"
#include "tests/scenes/triangles.hpp"
#include "tests/src/support/answer.hpp"

namespace onset::tests {
namespace {

using Eigen::MatrixXd;
using scenes::any;
using scenes::Random;
using scenes::triangles;
using scenes::uniform;

// Corners above faces, by nothing or 1e-18 to 1e-8: of one body, of two, and of what is linear.
struct Corners {
  static constexpr int kPairs = 8;
  MatrixXd x, x1;
  RigidTrajectory motion;
  explicit Corners(Random& random) : x(start(random)), x1(moved(x, random)), motion(x, x1) {
    if (scenes::coin(random))
      lift(random);
    else
      spin(random);
  }

 private:
  void spin(Random& random) {
    std::vector<int> bodies[3];
    for (int part = 0; part < 2 * kPairs; ++part) put(part, scenes::integer(random, -1, 2), bodies);
    const double way = scenes::coin(random) ? 1 : 1e6;  // with what storing makes of it
    for (const std::vector<int>& body : bodies)
      motion.add_body(body, any(random, scenes::coin(random) ? 2 : 1e-20).transpose(),
                      Eigen::Vector3d(way, uniform(random, -0.1, 0.1), uniform(random, -0.1, 0.1)),
                      any(random, 1).transpose());
  }
  static void put(int part, int body, std::vector<int> (&bodies)[3]) {
    for (int v = 3 * part; body >= 0 && v < 3 * part + 3; ++v) bodies[body].push_back(v);
  }
  // The first corners turn about an axis through them and part from one face, which storing alone brings
  // near; others may touch within the face's body.
  void lift(Random& random) {
    std::vector<int> bodies[3];
    for (int k = 0; k < kPairs; ++k) {
      const int shift = k < kPairs / 2 ? -50 * k : -200;
      x.middleRows(6 * k, 3).col(2).array() += shift;
      if (k >= kPairs / 2) x.middleRows(6 * k + 3, 3).col(2).array() += shift;
      put(2 * k, k == 1 ? 1 : 0, bodies);
      put(2 * k + 1, k < kPairs / 2 ? 1 : 0, bodies);
      if (k >= kPairs / 2) continue;
      x.row(6 * k + 3) << 2e-8 * k, 0, uniform(random, 0.5e-9, 1.5e-9);
      for (int v = 4; v < 6; ++v) x.row(6 * k + v) << 1 + k, 0.1 * (v - 3), 1;
    }
    x.topRows(3) << -10, -10, 0, 30, -10, 0, -10, 30, 0;
    x.middleRows(6, 3) << 1e6, 0, 7, 1e6, 1, 7, 1e6, 0, 8;  // so that pieces are short
    motion = RigidTrajectory(x);
    motion.add_body(bodies[0], {0, 0, 1e-20}, {1e6, 0, 0}, {0, 0, 0});
    motion.add_body(bodies[1], {0, 0, 3}, {1e6, 0, 1}, {0, 0, 0});
  }
  static MatrixXd start(Random& random) {
    MatrixXd x(6 * kPairs, 3);
    for (int k = 0; k < kPairs; ++k) {
      const int power = scenes::integer(random, -18, -9);
      const double gap =
          scenes::integer(random, 0, 7) == 0 ? 0 : scenes::power_of_ten(random, power, power + 1);
      x.middleRows(6 * k, 6) << 0, 0, 0, 1, 0, 0, 0, 1, 0, .2, .2, gap, .3, .2, 1, .2, .3, 1;
      x.middleRows(6 * k, 6).col(0).array() += 2 * k - kPairs;
    }
    return x;
  }
  static MatrixXd moved(MatrixXd x, Random& random) {
    for (Eigen::Index v = 0; v < x.rows(); ++v) x.row(v) += any(random, 0.05);
    return x;
  }
};

bool is_same(const Contact& x, const Contact& y) {
  return x.kind == y.kind && x.a == y.a && x.b == y.b && x.toi == y.toi && x.outcome == y.outcome;
}

}  // namespace

TEST_CASE("an active set of a trajectory says until when memory was enough", "[trajectory]") {
  constexpr int kCount = 12;  // triangles fall on one that stands, one after the other
  MatrixXd x(3 * (kCount + 1), 3);
  x.topRows(3) << -100, -100, 0, 300, -100, 0, -100, 300, 0;
  for (int k = 1; k <= kCount; ++k)
    x.middleRows(3 * k, 3) << 5 * k, 0, 0.07 * k, 5 * k, 0.1, 0.07 * k + 2, 5 * k + 0.1, 0.1, 0.07 * k + 2;
  RigidTrajectory t(x);
  for (int k = 1; k <= kCount; ++k) t.add_body(3 * k, 3 * k + 3, {0, 0, 3}, {0, 0, -1}, {5.0 * k, 0, 0});
  const Mesh mesh(x, triangles(kCount + 1));
  const ActiveSet all = construct_active_set(mesh, t);
  double latest = 0;
  for (int pairs = 0; pairs < kCount; ++pairs) {
    Options o;
    o.memory_limit = 256 * pairs;
    const ActiveSet some = construct_active_set(mesh, t, o);
    latest = std::max(latest, std::min(some.complete_until, 1.0));
    for (const Contact& c : all) {
      if (!(c.toi < some.complete_until)) continue;
      const auto same = [&](const Contact& s) { return s.kind == c.kind && s.a == c.a && s.b == c.b; };
      REQUIRE(std::any_of(some.begin(), some.end(), same));
    }
  }
  CHECK(latest > 0);
}

TEST_CASE("little memory hides no contact within a body that turns", "[trajectory]") {
  constexpr int kNear = 3,
                kFirst = 3 + 3 * kNear;  // what only storing brings near, and the body's other part
  MatrixXd x(kFirst + 9, 3);
  x.topRows(3) << -10, -10, 0, 30, -10, 0, -10, 30, 0;
  for (int k = 0; k < kNear; ++k) x.middleRows(3 + 3 * k, 3) << k * 2e-8, 0, 1e-9, 1 + k, .1, 1, 1 + k, .2, 1;
  x.middleRows(kFirst, 6) << 0, 0, -5, 1, 0, -5, 0, 1, -5, .2, .2, -5, .3, .2, -6, .2, .3, -6;
  x.bottomRows(3) << 1e6, 0, 7, 1e6, 1, 7, 1e6, 0, 8;
  std::vector<int> touching, above;
  for (int v = 0; v < int(x.rows()); ++v)
    (v < 3 || (v >= kFirst && v < kFirst + 6) ? touching : above).push_back(v);
  const Mesh mesh(x, triangles(int(x.rows()) / 3));
  RigidTrajectory t(x);
  t.add_body(touching, {0, 0, 1e-20}, {1e6, 0, 0}, {0, 0, 0});
  t.add_body(above, {0, 0, 3}, {1e6, 0, 1}, {0, 0, 0});
  for (const int contacts : {1000, 10, 2, 1, 0}) {
    Options o;
    o.memory_limit = 256 * contacts;
    CAPTURE(contacts);
    CHECK(compute_collision_free_stepsize(mesh, t, o).outcome == Outcome::initial_contact);
    CHECK_FALSE(is_step_collision_free(mesh, t, o));
    const ActiveSet set = construct_active_set(mesh, t, o);
    CHECK((contacts > 0 ? set.size() > 0 && set[0].a == kFirst + 3 : set.complete_until == 0));
  }
}

TEST_CASE("with any memory a trajectory answers the same, or says what is missing", "[trajectory]") {
  int missing = 0, contacts = 0;
  for (int i = 0; i < fuzz(40); ++i) {
    Random random(std::uint64_t(i) + 4714);
    const Corners scene(random);
    const Mesh mesh(scene.x, triangles(2 * Corners::kPairs));
    Options o;
    if (scenes::coin(random)) o.min_separation = scenes::power_of_ten(random, -13, -1);
    if (scenes::coin(random)) o.window = uniform(random, 0, 0.5);
    const StepResult step = compute_collision_free_stepsize(mesh, scene.motion, o);
    const ActiveSet all = construct_active_set(mesh, scene.motion, o);
    const bool free = is_step_collision_free(mesh, scene.motion, o);
    for (const int room : {0, 1, 2, 3, 5, 9, 17, 40}) {
      o.memory_limit = 256 * room;
      CAPTURE(i, room, o.min_separation, o.window, all.size());
      const StepResult r = compute_collision_free_stepsize(mesh, scene.motion, o);
      if (r.outcome == Outcome::out_of_memory)
        REQUIRE((r.step == 0 && r.shortest == 0));
      else
        REQUIRE(Answer().add(r) == Answer().add(step));
      if (is_step_collision_free(mesh, scene.motion, o)) REQUIRE(free);
      const ActiveSet some = construct_active_set(mesh, scene.motion, o);
      REQUIRE(some.size() <= std::size_t(room));
      REQUIRE(some.complete_until <= all.complete_until);
      missing += some.outcome == Outcome::out_of_memory, contacts += int(some.size());
      if (some.outcome != Outcome::out_of_memory) REQUIRE(Answer().add(some) == Answer().add(all));
      for (const Contact& c : some)
        REQUIRE(std::any_of(all.begin(), all.end(), [&](const Contact& d) { return is_same(c, d); }));
      for (const Contact& c : all)
        if (c.toi < some.complete_until)
          REQUIRE(std::any_of(some.begin(), some.end(), [&](const Contact& d) { return is_same(c, d); }));
    }
  }
  CHECK((missing > fuzz(40) && contacts > fuzz(40)));
}

}  // namespace onset::tests
