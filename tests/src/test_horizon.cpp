// The step's shrunk horizon: bit for bit the minimum of the active set.
#include <algorithm>
#include <onset/onset.hpp>

#include "tests/catch.hpp"
#include "tests/src/soups.hpp"

using namespace onset;

TEST_CASE("the step is the active set's earliest toi, for every seed, size and separation", "[property]") {
  int contacts = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const auto [soup, mesh, options] = tests::soup(seed, 20 + int(seed) * 10);
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

TEST_CASE("exact: the step is the earliest contact between adjacent doubles, at any tolerance",
          "[property]") {
  int contacts = 0;
  for (unsigned seed = 1; seed <= 16; ++seed) {
    auto [soup, mesh, options] = tests::soup(seed, 20 + int(seed) * 20);
    options.min_separation = 0;
    options.certainty = CertaintyLevel::exact;
    StepResult first;
    std::vector<std::array<int, 4>> found;
    for (double tolerance : {1e-2, 1e-6, 1e-10}) {
      options.relative_tolerance = tolerance;
      options.threads = tolerance == 1e-6 ? 2 : 1;
      const StepResult step = compute_collision_free_stepsize(mesh, soup.x_t0, soup.x_t1, options);
      const ActiveSet set = construct_active_set(mesh, soup.x_t0, soup.x_t1, options);
      if (tolerance == 1e-2) first = step, found = set.vertices;
      REQUIRE(step.step == first.step);
      REQUIRE(step.toi_hi == first.toi_hi);
      REQUIRE(step.outcome == first.outcome);
      REQUIRE(step.limiting.vertices == first.limiting.vertices);
      REQUIRE(set.vertices == found);
      REQUIRE((step.outcome == Outcome::free) == (set.size() == 0));
      REQUIRE(is_step_collision_free(mesh, soup.x_t0, soup.x_t1, options) == (set.size() == 0));
      if (set.size() == 0 ||
          std::count(set.status.begin(), set.status.end(), Outcome::initial_separating) > 0)
        continue;
      const std::size_t earliest = std::size_t(set.earliest());
      REQUIRE(set.toi[earliest] == step.step);
      REQUIRE(set.toi_hi[earliest] == step.toi_hi);
      REQUIRE((step.toi_hi == step.step || step.toi_hi == std::nextafter(step.step, 2)));
      ++contacts;
    }
  }
  CHECK(contacts > 15);
}
