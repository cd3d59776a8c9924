// The step's shrunk horizon: bit for bit the minimum of the active set.
#include <algorithm>
#include <onset/onset.hpp>

#include "tests/catch.hpp"
#include "tests/scenes/meshes.hpp"

using namespace onset;

TEST_CASE("the step is the active set's earliest toi, for every seed, size and separation", "[property]") {
  int contacts = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    scenes::Random random(seed);
    const scenes::Scene soup =
        scenes::triangle_soup(20 + int(seed) * 10, 0.15, seed % 4 == 0 ? 0.02 : 0.2, random);
    const Mesh mesh(soup.x_t0, soup.faces);
    Options options;
    options.min_separation = seed % 3 == 0 ? 1e-3 : 0;
    options.relative_tolerance = seed % 2 == 0 ? 1e-3 : 1e-7;
    const ActiveSet set = construct_active_set(mesh, soup.x_t0, soup.x_t1, options);
    const StepResult step = compute_collision_free_stepsize(mesh, soup.x_t0, soup.x_t1, options);
    double earliest = 1;
    for (std::size_t i = 0; i < set.size(); ++i)
      if (set.status[i] != Outcome::initial_separating) earliest = std::min(earliest, set.toi[i]);
    contacts += earliest < 1;
    if (std::count(set.status.begin(), set.status.end(), Outcome::initial_separating) == 0)
      REQUIRE(step.step == earliest);
  }
  CHECK(contacts > 20);
}
