// Scenes whose coordinates are a few times the least double: everything that is promised for others, and
// distances that are safe whatever they are halved and rounded to.
#include "tests/catch.hpp"
#include "tests/oracle/promises.hpp"
#include "tests/scenes/families.hpp"
#include "tests/steps/support/promises.hpp"
#include "tests/steps/support/random_scenes.hpp"

using namespace onset;
using namespace onset::tests;
using scenes::Random;

namespace {

StepScene in_units_of_eta(StepScene scene, double unit) {
  scene.x_t0 *= unit, scene.x_t1 *= unit;
  return scene;
}

// On a grid of whole numbers times unit * 2^-1074.
StepScene tiny_grid(Random& random) {
  StepScene s = grid_scene(random);
  const double size = std::max(s.x_t0.cwiseAbs().maxCoeff(), s.x_t1.cwiseAbs().maxCoeff());
  if (size == 0) return s;
  const double whole = std::ldexp(1.0, -std::ilogb(size) + scenes::integer(random, 0, 12));
  for (Eigen::MatrixXd* x : {&s.x_t0, &s.x_t1}) *x = (*x * whole).array().round();
  return in_units_of_eta(s, 0x1p-1074);
}

// By the lemma: whatever path vertices take within their distances, no pair comes within its separation.
std::string unsafe(const Asked& asked, const std::vector<double>& r) {
  std::string broken;
  asked.for_pairs([&](PairKind kind, int, int, const std::array<int, 4>& v) {
    const int first = scenes::first_body(kind);
    const double moved = thickest(r, v, 0, first) + thickest(r, v, first, 4);  // the largest of each side
    if (moved == 0 || !broken.empty()) return;
    const scenes::Query query = query_of(kind, v, asked.x_t0, asked.x_t0);
    const double d = asked.separation(kind, v);
    if (oracle::compare_distance(query, 0, d + moved, asked.options.norm) <= 0) broken = to_text(query);
  });
  return broken;
}

}  // namespace

TEST_CASE("subnormal scenes keep every promise, whatever is asked", "[property][oracle]") {
  Random random(oracle::fuzz_seed() * 1000 + 71);
  for (int i = 0; i < oracle::fuzz(100); ++i) {
    const StepScene scene = tiny_grid(random);
    Options options = random_options(scene, random);
    options.min_separation = 0x1p-1074 * (scenes::integer(random, 0, 3) ? 0 : scenes::integer(random, 1, 8));
    const Calls calls(scene);
    const double d_hat = 0x1p-1074 * scenes::integer(random, 1, 4000);
    INFO("scene " << i << ", tolerance " << options.tolerance.value_or(0) << ", relative "
                  << options.relative_tolerance << ", separation " << options.min_separation << ", norm "
                  << int(options.norm) << ", certainty " << int(options.exactness) << ", checks "
                  << options.max_checks << ", narrow " << int(options.narrow_phase));
    CHECK(broken_promise({calls.mesh(), scene.x_t0, scene.x_t1, options, {}}, calls, d_hat) == "");
  }
}

TEST_CASE("safe distances of both sides stay below the gap, subnormal or not", "[property][oracle]") {
  Random random(oracle::fuzz_seed() * 1000 + 72);
  int moved = 0;
  for (int i = 0; i < oracle::fuzz(300); ++i) {
    const StepScene scene = scenes::coin(random) ? tiny_grid(random) : random_scene(random);
    const Mesh mesh = scene.mesh();
    Options options;
    const double size = (scene.x_t0.colwise().maxCoeff() - scene.x_t0.colwise().minCoeff()).maxCoeff();
    if (!(size < 0x1p1000)) continue;
    if (scenes::integer(random, 0, 3) == 0) options.min_separation = size / 64;
    const double d_hat = std::max(0x1p-1074, size * scenes::power_of_ten(random, -4, 1));
    const Asked asked{mesh, scene.x_t0, scene.x_t0, options, {}};
    const std::vector<double> r =
        safe_distances(mesh, scene.x_t0, close_pairs(mesh, scene.x_t0, d_hat, options));
    INFO("scene " << i << ", d_hat " << d_hat << ", separation " << options.min_separation);
    CHECK(unsafe(asked, r) == "");
    moved += *std::max_element(r.begin(), r.end()) > 0;
  }
  CHECK(2 * moved > oracle::fuzz(300));
}
