// Rules that single out pairs, alone and together, in random scenes: every call against exact contacts, where
// each pair keeps its own separation, or is left out as a neighbour.
#include "tests/catch.hpp"
#include "tests/oracle/promises.hpp"
#include "tests/steps/support/pair_separations.hpp"
#include "tests/steps/support/promises.hpp"
#include "tests/steps/support/random_scenes.hpp"

using namespace onset;
using namespace onset::tests;

namespace {

struct Counts {
  int scenes = 0, contacts = 0, neighbours = 0, lowered = 0, of_bodies = 0;
};

void check_scene(const StepScene& scene, scenes::Random& random, Counts& counts) {
  Options options = random_options(scene, random);
  CollisionRules rules;
  if (scenes::coin(random)) rules.points = scene.points();
  add_pair_rules(scene, random, options, rules);
  if (scenes::integer(random, 0, 5) == 0 && options.norm == Norm::euclidean)
    rules.thickness = random_thickness(scene, random);
  Calls calls(scene);
  calls.mesh().set_rules(rules);
  std::string wrong;
  Asked asked{calls.mesh(), scene.x_t0, scene.x_t1, options, rules.thickness};
  asked.keeps = separations_of(calls.mesh(), options, wrong);
  asked.lets = beyond_rings(calls.mesh());
  CAPTURE(rules.excluded_rings, rules.rest_share, rules.rest_positions.rows(), rules.body_separations.size(),
          rules.thickness.size(), options.min_separation, int(options.norm), int(options.exactness));
  CHECK(wrong == "");
  const double size = (scene.x_t0.colwise().maxCoeff() - scene.x_t0.colwise().minCoeff()).maxCoeff();
  const double d_hat = std::clamp(size * scenes::power_of_ten(random, -4, 1), 0x1p-1060, 0x1p1000);
  CHECK(broken_promise(asked, calls, d_hat) == "");
  ++counts.scenes;
  counts.contacts += SceneTruth(asked).first().collides;
  counts.neighbours += calls.mesh().filter_counts().edge_edge.within_rings > 0;
  counts.lowered += rules.rest_positions.rows() > 0 && options.min_separation > 0;
  counts.of_bodies += !rules.body_separations.empty();
}

Counts check_scenes(int count, std::uint64_t seed, StepScene (*make)(scenes::Random&)) {
  scenes::Random random(oracle::fuzz_seed() * 1000 + seed);
  Counts counts;
  for (int i = 0; i < count; ++i) {
    INFO("scene " << i);
    check_scene(make(random), random, counts);
  }
  return counts;
}

}  // namespace

TEST_CASE("no step of a scene with rules for pairs is late, whatever is asked", "[property][oracle]") {
  const Counts grid = check_scenes(oracle::fuzz(80), 21, grid_scene);
  CAPTURE(grid.contacts, grid.lowered, grid.of_bodies);
  CHECK((4 * grid.contacts > grid.scenes && 8 * grid.lowered > grid.scenes));
  CHECK(8 * grid.of_bodies > grid.scenes);
  const Counts floor = check_scenes(oracle::fuzz(80), 22, floor_scene);
  CAPTURE(floor.contacts, floor.lowered, floor.of_bodies);
  CHECK((6 * floor.contacts > floor.scenes && 8 * floor.lowered > floor.scenes));
  CHECK(8 * floor.of_bodies > floor.scenes);
}

TEST_CASE("no step of tetrahedra or a crowd with rules for pairs is late", "[property][oracle]") {
  const Counts solid = check_scenes(oracle::fuzz(20), 23, tetrahedra);
  CHECK((10 * solid.neighbours > solid.scenes || solid.scenes < 20));
  const Counts crowd = check_scenes(oracle::fuzz(10), 24, crowded_scene);
  CHECK(4 * crowd.contacts > crowd.scenes);
}
