// Whole scenes against exact contacts, whatever the options: the step, where storing it leaves every pair,
// what the five calls say, the active set, and that they agree.
#include <algorithm>
#include <sstream>

#include "tests/catch.hpp"
#include "tests/oracle/promises.hpp"
#include "tests/steps/support/promises.hpp"
#include "tests/steps/support/random_scenes.hpp"

using namespace onset;
using namespace onset::tests;

namespace {

std::string to_text(const Options& o) {
  std::ostringstream s;
  s << "tolerance " << o.tolerance.value_or(0) << ", relative " << o.relative_tolerance << ", separation "
    << o.min_separation << ", norm " << int(o.norm) << ", exactness " << int(o.exactness) << ", checks "
    << o.max_checks << ", narrow " << int(o.narrow_phase) << ", broad " << int(o.broad_phase) << ", window "
    << o.window << ", passes " << o.touching_may_pass_through;
  return s.str();
}

struct Counts {
  int scenes = 0, contacts = 0, initial = 0, at_the_end = 0;
};

// What the mesh is told, and the calls that have these are asked.
struct More {
  double d_hat, gap_share;
  bool points = false, weld = false;
  std::vector<double> thickness;
};

void check_scene(const StepScene& scene, const Options& options, const More& what, Counts& counts) {
  Calls calls(scene);
  CollisionRules rules;
  if (what.points) rules.points = scene.points();
  rules.thickness = what.thickness;
  rules.weld = what.weld;
  calls.mesh().set_rules(rules);
  const Asked asked{calls.mesh(), scene.x_t0, scene.x_t1, options, what.thickness, what.weld};
  const oracle::Truth first = SceneTruth(asked).first();
  ++counts.scenes, counts.contacts += first.collides, counts.initial += first.toi_hi == 0;
  counts.at_the_end += first.toi_lo == 1;
  const std::string broken = broken_promise(asked, calls, what.d_hat, what.gap_share);
  if (broken.empty()) return;
  INFO(to_text(options) << ", d_hat " << what.d_hat << ", gap_share " << what.gap_share << ", points "
                        << what.points << ", weld " << what.weld << ", thick " << what.thickness.size()
                        << ", exact " << first.toi_lo << " " << first.toi_hi);
  FAIL_CHECK(broken);
}

double some_d_hat(const StepScene& scene, scenes::Random& random) {
  const double size = (scene.x_t0.colwise().maxCoeff() - scene.x_t0.colwise().minCoeff()).maxCoeff();
  return std::clamp(size * scenes::power_of_ten(random, -4, 1), 0x1p-1060, 0x1p1000);
}

Counts check_scenes(int count, std::uint64_t seed, StepScene (*make)(scenes::Random&)) {
  scenes::Random random(oracle::fuzz_seed() * 1000 + seed);
  Counts counts;
  for (int i = 0; i < count; ++i) {
    const StepScene scene = make(random);
    Options options = random_options(scene, random);
    More more{
        some_d_hat(scene, random), kGapShare, scenes::coin(random), scenes::integer(random, 0, 4) == 0, {}};
    if (scenes::coin(random)) more.gap_share = scenes::coin(random) ? 0 : scenes::uniform(random, 0, 0.99);
    if (scenes::integer(random, 0, 7) == 0 && options.norm == Norm::euclidean)
      options.min_separation = 0, more.thickness = random_thickness(scene, random);
    options.touching_may_pass_through = scenes::integer(random, 0, 7) == 0;
    INFO("scene " << i);
    check_scene(scene, options, more, counts);
  }
  return counts;
}

}  // namespace

TEST_CASE("no step of a scene on a grid is late, whatever is asked", "[property][oracle]") {
  const Counts c = check_scenes(oracle::fuzz(100), 1, grid_scene);
  CHECK(10 * c.contacts > 5 * c.scenes);
  CHECK(20 * c.initial > c.scenes);
}

TEST_CASE("no step of a scene over a floor is late, whatever is asked", "[property][oracle]") {
  const Counts c = check_scenes(oracle::fuzz(150), 2, floor_scene);
  CHECK(10 * c.contacts > 4 * c.scenes);
  CHECK(20 * c.at_the_end > c.scenes);
}

TEST_CASE("no step of pairs of any family in one scene is late, whatever is asked", "[property][oracle]") {
  const Counts c = check_scenes(oracle::fuzz(150), 3, family_scene);
  CHECK(10 * c.contacts > 2 * c.scenes);
}

TEST_CASE("no step of tetrahedra that meet is late, whatever is asked", "[property][oracle]") {
  const Counts c = check_scenes(oracle::fuzz(25), 4, tetrahedra);
  CHECK(10 * c.contacts > 2 * c.scenes);
}

TEST_CASE("no step of a crowded scene is late, whatever is asked", "[property][oracle]") {
  const Counts c = check_scenes(oracle::fuzz(20), 5, crowded_scene);
  CHECK(10 * c.contacts > 5 * c.scenes);
}
