// RigidTrajectory: what is stored of a turning vertex, and how far it strays from its chord, in 50 digits.
#include <cmath>
#include <limits>
#include <onset/trajectory.hpp>

#include "scene/motion/rotation.hpp"
#include "tests/catch.hpp"
#include "tests/fuzz.hpp"
#include "tests/scenes/random.hpp"
#include "tests/trajectory/exact_path.hpp"

namespace onset::tests {
namespace {

using scenes::integer;
using scenes::power_of_ten;
using scenes::Random;
using scenes::uniform;
using scenes::unit;

constexpr double kU = 0x1p-53;

Eigen::Vector3d vector(Random& random, double size) {
  return {uniform(random, -size, size), uniform(random, -size, size), uniform(random, -size, size)};
}

struct Case {
  RigidMotion motion;
  Eigen::Vector3d p;
};

// Angles from 1e-12 to a thousand turns, centres near and far, translations of any size.
Case random_case(Random& random) {
  const double size = power_of_ten(random, -6, 6);
  Case c;
  c.p = vector(random, size);
  const double angle = integer(random, 0, 3) == 0 ? power_of_ten(random, -12, 3.8) : uniform(random, 0, 7);
  Eigen::Vector3d axis = vector(random, 1);
  if (integer(random, 0, 3) == 0) axis = Eigen::Vector3d::Unit(integer(random, 0, 2));
  c.motion.rotation = axis.normalized() * angle;
  c.motion.translation = vector(random, size * (integer(random, 0, 1) ? power_of_ten(random, -8, 2) : 0));
  c.motion.centre = vector(random, size * (integer(random, 0, 1) ? power_of_ten(random, -3, 3) : 0));
  return c;
}

RigidTrajectory trajectory_of(const Case& c) {
  RigidTrajectory r(c.p.transpose());
  r.add_body(0, 1, c.motion.rotation, c.motion.translation, c.motion.centre);
  return r;
}

RealPoint difference(const RealPoint& a, const RealPoint& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
RealPoint stored(const Trajectory& trajectory, double t) {
  const int v = 0;
  double x[3];
  trajectory.positions(t, &v, 1, x);
  return {Real(x[0]), Real(x[1]), Real(x[2])};
}

}  // namespace

TEST_CASE("sine and cosine are within 6.5u, the sine within 8u of its angle", "[trajectory]") {
  Random random(31);
  double worst = 0, worst_of_angle = 0;
  for (int i = 0; i < fuzz(20000); ++i) {
    const double x = i % 2 == 0 ? uniform(random, 0, 7) : std::min(power_of_ten(random, -20, 6.03), 0x1p20);
    const SineCosine at = sine_cosine(x);
    const Real s = sin(Real(x)), c = cos(Real(x));
    const double es = double(abs(s - at.sine)) / kU, ec = double(abs(c - at.cosine)) / kU;
    worst = std::max({worst, es, ec});
    worst_of_angle = std::max(worst_of_angle, es / x);
  }
  CHECK(worst <= 6.5);
  CHECK(worst_of_angle <= 8);
  std::printf("sine and cosine err by at most %.3gu, the sine by %.3gu of its angle\n", worst,
              worst_of_angle);
  CHECK(sine_cosine(0).sine == 0);
  CHECK(sine_cosine(0).cosine == 1);
}

TEST_CASE("a turning vertex is stored within the bound of its rounding", "[trajectory]") {
  Random random(32);
  double closest = 0;
  for (int i = 0; i < fuzz(4000); ++i) {
    const Case c = random_case(random);
    const RigidTrajectory trajectory = trajectory_of(c);
    const double t = integer(random, 0, 3) == 0 ? power_of_ten(random, -15, 0) : unit(random);
    const Real error =
        length(difference(stored(trajectory, t), exact_position(c.motion, Real(t), c.p.data())));
    const Turn turn =
        make_turn(c.motion.rotation.data(), c.motion.translation.data(), c.motion.centre.data());
    const double bound = rounding_of_turn(turn, orbit_of(turn, c.p.data()), t);
    INFO("angle " << c.motion.rotation.norm() << ", t " << t);
    REQUIRE(error <= bound);
    // The bound that the header names.
    REQUIRE(bound <=
            kU *
                    (c.p.norm() + 84 * t * c.motion.rotation.norm() * (c.p - c.motion.centre).norm() +
                     5 * t * c.motion.translation.norm()) *
                    (1 + 0x1p-29) +
                1e-300);
    closest = std::max(closest, double(error) / bound);
  }
  std::printf("rounding of a turning vertex: at most %.3f of its bound\n", closest);
  CHECK(closest > 0.05);  // or the bound is no good
}

TEST_CASE("a turning vertex strays from its chord by no more than its bound", "[trajectory]") {
  Random random(33);
  double closest = 0, closest_of_large = 0;
  for (int i = 0; i < fuzz(3000); ++i) {
    const Case c = random_case(random);
    const RigidTrajectory trajectory = trajectory_of(c);
    double t0 = unit(random), t1 = std::min(1.0, t0 + power_of_ten(random, -12, 0));
    if (integer(random, 0, 9) == 0) t0 = 0, t1 = power_of_ten(random, -14, 0);
    if (integer(random, 0, 19) == 0) t1 = t0;
    const int v = 0;
    double bound;
    trajectory.straying(t0, t1, &v, 1, &bound);
    const RealPoint x0 = stored(trajectory, t0), x1 = stored(trajectory, t1);
    for (int k = 0; k <= 6; ++k) {
      const double t = k == 3 ? 0.5 * t0 + 0.5 * t1 : std::min(t1, t0 + unit(random) * (t1 - t0));
      const Real s = t1 > t0 ? (Real(t) - Real(t0)) / (Real(t1) - Real(t0)) : Real(0);
      RealPoint chord;
      for (std::size_t a = 0; a < 3; ++a) chord[a] = x0[a] + s * (x1[a] - x0[a]);
      const Real true_strays = length(difference(exact_position(c.motion, Real(t), c.p.data()), chord));
      const Real stored_strays = length(difference(stored(trajectory, t), chord));
      INFO("angle " << c.motion.rotation.norm() << " from " << t0 << " to " << t1 << " at " << t);
      REQUIRE(true_strays <= bound);
      REQUIRE(stored_strays <= bound);
      closest = std::max(closest, double(true_strays) / bound);
      if ((t1 - t0) * c.motion.rotation.norm() > 0.1)
        closest_of_large = std::max(closest_of_large, double(true_strays) / bound);
    }
  }
  std::printf("straying: at most %.6f of its bound\n", closest);
  CHECK(closest_of_large > 0.999999);  // it is attained in the middle
}

TEST_CASE("a rigid trajectory starts exactly, and moves what does not turn linearly", "[trajectory]") {
  Eigen::MatrixXd x0 = Eigen::MatrixXd::Random(6, 3), x1 = Eigen::MatrixXd::Random(6, 3);
  RigidTrajectory r(x0, x1);
  CHECK(r.add_body({0, 2}, {0.1, 3, -2}, {1, 2, 3}, {1e6, 0, 1}) == 0);
  CHECK(r.add_body(4, 5, {0, 0, 0}, {1, 0, 0}, {0, 0, 0}) == 1);
  CHECK(r.num_vertices() == 6);
  CHECK(r.at(0) == x0);
  for (const int v : {1, 3, 5}) {
    CHECK(r.body(v) == Trajectory::kLinear);
    CHECK(r.at(1).row(v) == x1.row(v));
    CHECK(r.at(0.5).row(v) == x0.row(v) + 0.5 * (x1.row(v) - x0.row(v)));
  }
  CHECK(r.body(0) == 0);
  CHECK(r.body(2) == 0);
  CHECK(r.body(4) == Trajectory::kLinear);
  CHECK(r.at(1).row(4) == x0.row(4) + Eigen::RowVector3d(1, 0, 0));
  const RigidTrajectory copy = r;
  CHECK(copy.at(0.7) == r.at(0.7));
}

TEST_CASE("a rigid trajectory refuses what it does not support", "[trajectory]") {
  const Eigen::MatrixXd x = Eigen::MatrixXd::Zero(3, 3);
  const Eigen::Vector3d one(0, 0, 1), none(0, 0, 0);
  CHECK_THROWS_AS(RigidTrajectory(x, Eigen::MatrixXd::Zero(2, 3)), std::invalid_argument);
  CHECK_THROWS_AS(RigidTrajectory(Eigen::MatrixXd::Zero(3, 2)), std::invalid_argument);
  RigidTrajectory r(x);
  CHECK_THROWS_AS(r.add_body({0, 3}, one, none, none), std::invalid_argument);
  CHECK_THROWS_AS(r.add_body({0, -1}, one, none, none), std::invalid_argument);
  CHECK_THROWS_AS(r.add_body({0, 0}, one, none, none), std::invalid_argument);
  CHECK_THROWS_AS(r.add_body(1, 4, one, none, none), std::invalid_argument);
  CHECK_THROWS_AS(r.add_body({0}, one * 0x1p21, none, none), std::invalid_argument);
  CHECK(r.body(0) == Trajectory::kLinear);  // nothing of these has stayed
  r.add_body({0}, one, none, none);
  CHECK_THROWS_AS(r.add_body({1, 0}, one, none, none), std::invalid_argument);
  r.add_body({1}, one * std::numeric_limits<double>::quiet_NaN(), none, none);
  CHECK(std::isnan(r.at(1)(1, 0)));
  CHECK(r.at(0) == x);
}

}  // namespace onset::tests
