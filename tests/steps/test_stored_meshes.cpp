// Meshes pushed into one another, and into themselves, from stored position to stored position, by each of
// the calls: no stored state touches or pierces itself, and none is stuck while every gap has room.
#include "tests/catch.hpp"
#include "tests/oracle/promises.hpp"
#include "tests/oracle/stored.hpp"
#include "tests/scenes/meshes.hpp"
#include "tests/steps/support/calls.hpp"
#include "tests/steps/support/mesh_state.hpp"
#include "tests/steps/support/promises.hpp"

using namespace onset;
using namespace onset::tests;
using scenes::Random;
using scenes::Scene;

namespace {

constexpr double kOffsets[] = {0, 1, 1e3, 1e5, 1e7, 1e9};
constexpr int kPushes = 60;

struct Bodies {
  Scene scene;             // at rest
  int first;               // rows of the first body; 0: there is one
  bool is_static = false;  // the second body is static
};

Bodies some_bodies(Random& random) {
  Scene upper, lower;
  switch (scenes::integer(random, 0, 3)) {
    case 0:
      upper = scenes::translated(scenes::sphere(1, 3), {0.1, 0.2, 2.2});
      lower = scenes::cube();
      break;
    case 1:
      upper = scenes::translated(scenes::cloth(3, 3), {0.13, 0.21, 0.01});
      lower = scenes::cloth(2, 3);
      break;
    case 2:
      upper = scenes::translated(scenes::cube(), {0.25, 0.25, 2 + 0x1p-10});
      lower = scenes::cube();
      break;
    default:
      upper = scenes::cloth(4, 3);
      for (Eigen::Index v = 0; v < upper.x_t0.rows(); ++v)
        upper.x_t0(v, 2) = 0.2 * std::pow(upper.x_t0(v, 0) - 0.5, 2), upper.x_t0(v, 0) *= 0.5;
      upper.x_t1 = upper.x_t0;
      return {upper, 0, false};
  }
  return {scenes::joined(upper, lower), int(upper.x_t0.rows()), false};
}

// The second body, which may be static. It is stored anew in every push, and not always where it was.
std::vector<bool> below(const Bodies& bodies) {
  std::vector<bool> flags(std::size_t(bodies.scene.x_t0.rows()), true);
  std::fill_n(flags.begin(), bodies.first, false);
  return flags;
}

// Every vertex of a body by one step, and each by some of its own; a body of one part is squeezed.
Eigen::MatrixXd aimed(const Bodies& bodies, const Eigen::MatrixXd& x, Random& random) {
  Eigen::MatrixXd to = x;
  const double far = scenes::power_of_ten(random, -4, 0.3), noise = scenes::coin(random) ? 0 : far;
  const Eigen::RowVector3d middle = x.colwise().mean();
  const Point step = scenes::plus({0, 0, -far}, scenes::point(random, scenes::coin(random) ? 0 : 0.5 * far));
  for (Eigen::Index v = 0; v < (bodies.is_static ? bodies.first : x.rows()); ++v) {
    const Point own = scenes::point(random, 0.2 * noise);
    for (int a = 0; a < 3; ++a) {
      if (v < bodies.first) to(v, a) += step[std::size_t(a)];
      if (bodies.first == 0 && a == 0) to(v, a) -= 2 * far * (x(v, a) - middle[a]);
      to(v, a) += own[std::size_t(a)];
    }
  }
  return to;
}

Eigen::MatrixXd stored(oracle::Rounding how, const Eigen::MatrixXd& x_t0, const Eigen::MatrixXd& x_t1,
                       double s) {
  Eigen::MatrixXd x(x_t0.rows(), 3);
  for (Eigen::Index i = 0; i < x.size(); ++i) x(i) = oracle::stored(how, x_t0(i), x_t1(i), s);
  return x;
}

struct Counts {
  long long pushes = 0, met = 0, stuck = 0, stopped = 0, refused = 0;
};

// False where a promise is broken.
bool push(const Calls& calls, Call call, const Eigen::MatrixXd& aim, Eigen::MatrixXd& x, Random& random,
          Counts& c) {
  const Eigen::MatrixXd x_t1 = end_of(call, x, aim);
  Options options;
  options.threads = 1;
  options.exactness = Exactness(scenes::integer(random, 0, 2));
  const Asked asked{calls.mesh(call), x, x_t1, options, {}};
  const CallStep step = calls.ask(call, x, x_t1, options, scenes::power_of_ten(random, -3, 0));
  ++c.pushes, c.stopped += step.result.step == 0;
  INFO(name(call) << ", " << to_string(step.result.outcome) << ", step " << step.result.step << ", rounding "
                  << step.result.rounding);
  if (step.result.step == 0) {
    const std::string broken = step.blind() ? "" : stuck(asked, step.result);
    c.stuck += !broken.empty();
    CHECK(broken == "");
    return broken.empty();
  }
  x = stored(oracle::kRoundings[scenes::integer(random, 0, 2)], x, x_t1, step.result.step);
  const std::string broken = meets_itself(calls.mesh(), x);
  c.met += !broken.empty();
  CHECK(broken == "");
  return broken.empty();
}

Counts push_all(int meshes, std::uint64_t seed) {
  Random random(oracle::fuzz_seed() * 1000 + seed);
  Counts counts;
  for (int i = 0; i < meshes; ++i) {
    Bodies bodies = some_bodies(random);
    bodies.is_static = bodies.first > 0 && scenes::coin(random);
    const double offset = kOffsets[scenes::integer(random, 0, 5)];
    const Point where = scenes::point(random, offset);
    bodies.scene = scenes::translated(bodies.scene, {where[0], where[1], where[2]});
    Calls calls({bodies.scene.x_t0, bodies.scene.x_t0, onset::edges(bodies.scene.faces), bodies.scene.faces});
    if (bodies.is_static) {
      CollisionRules rules;
      rules.static_vertices = below(bodies);
      calls.mesh().set_rules(rules);
    }
    if (!meets_itself(calls.mesh(), bodies.scene.x_t0).empty()) {
      ++counts.refused;
      continue;
    }
    for (Call call : kCalls) {
      CAPTURE(i, offset);
      Eigen::MatrixXd x = bodies.scene.x_t0;
      for (int k = 0; k < kPushes && push(calls, call, aimed(bodies, x, random), x, random, counts); ++k) {
      }
    }
  }
  std::printf("%d meshes pushed by every call: %lld pushes, %lld met, %lld stuck, %lld stopped\n", meshes,
              counts.pushes, counts.met, counts.stuck, counts.stopped);
  return counts;
}

// A triangle 2^-10 above a plate.
Scene triangle_over_plate() {
  Scene triangle{Eigen::MatrixXd(3, 3), {}, Eigen::MatrixXi(1, 3)},
      plate{Eigen::MatrixXd(3, 3), {}, Eigen::MatrixXi(1, 3)};
  triangle.x_t0 << 0, 0, 0x1p-10, 0.25, 0, 0.25, 0, 0.25, 0.25;
  plate.x_t0 << -2, -2, 0, 2, -2, 0, 0, 2, 0;
  triangle.faces << 0, 1, 2, plate.faces << 0, 1, 2;
  triangle.x_t1 = triangle.x_t0, plate.x_t1 = plate.x_t0;
  return scenes::joined(triangle, plate);
}

}  // namespace

TEST_CASE("meshes pushed on by any call never meet, nor are stuck while there is room",
          "[property][oracle]") {
  const Counts c = push_all(std::max(3, oracle::fuzz(6)), 21);
  CHECK(c.met + c.stuck == 0);
  CHECK(c.stopped > 0);
  CHECK(4 * c.refused <= oracle::fuzz(6) + 3);
}

// Empty, or what 20 pushes through the plate did.
static std::string pushed_down(const Scene& scene, Call call, oracle::Rounding how) {
  const Calls calls({scene.x_t0, scene.x_t0, onset::edges(scene.faces), scene.faces});
  Eigen::MatrixXd x = scene.x_t0;
  for (int i = 0; i < 20; ++i) {
    Eigen::MatrixXd to = x;
    to.col(2).head(3).array() -= 3 / 1024.0;
    to = end_of(call, x, to);
    const CallStep step = calls.ask(call, x, to, {}, 0.1);
    if (step.result.step == 0 && x(0, 2) - x(3, 2) > 2 * step.result.rounding) return "is stuck";
    x = stored(how, x, to, step.result.step);
    if (!(x(0, 2) > x(3, 2))) return "goes through in push " + std::to_string(i);
  }
  return {};
}

TEST_CASE("a triangle pushed onto a plate stays above it", "[regression][oracle]") {
  for (const Eigen::RowVector3d& where :
       {Eigen::RowVector3d(1000, -700, 130), Eigen::RowVector3d(0, 0, 0), Eigen::RowVector3d(3e6, 1e6, -5e6)})
    for (Call call : kCalls)
      for (oracle::Rounding how : oracle::kRoundings) {
        CAPTURE(name(call), int(how), where[0]);
        CHECK(pushed_down(scenes::translated(triangle_over_plate(), where), call, how) == "");
      }
}
