// Options::window: the earliest contacts alone, bit for bit as in the full set.
#include <algorithm>
#include <cmath>
#include <onset/onset.hpp>

#include "tests/catch.hpp"
#include "tests/src/support/scene_set.hpp"
#include "tests/src/support/soups.hpp"

using namespace onset;

namespace {

// The contacts of a full set that one with a window has.
std::vector<Contact> within(const ActiveSet& full, double window) {
  std::vector<Contact> kept;
  for (const Contact& contact : full)
    if (contact.toi <= full.earliest()->toi + window) kept.push_back(contact);
  return kept;
}
bool same(const ActiveSet& set, const std::vector<Contact>& contacts) {
  return std::equal(set.begin(), set.end(), contacts.begin(), contacts.end(), tests::same_but_certainty);
}

}  // namespace

TEST_CASE("a window gives the rows of the full set within it, bit for bit", "[property][determinism]") {
  int rows = 0, dropped = 0;
  for (unsigned seed = 1; seed <= 24; ++seed) {
    auto [soup, mesh, o] = tests::soup(seed, 20 + int(seed) * 20);
    if (seed % 5 == 0) o.max_checks = 50;  // too few for t_max
    const ActiveSet full = construct_active_set(mesh, soup.x_t0, soup.x_t1, o);
    CHECK(std::isinf(full.complete_until));
    for (const double window : {0.0, 1e-6, 0.01, 0.1, 0.5, 1.0, 7.0})
      for (const int threads : {1, 2}) {
        o.window = window;
        o.threads = threads;
        CAPTURE(seed, window, threads);
        const ActiveSet set = construct_active_set(mesh, soup.x_t0, soup.x_t1, o);
        CHECK(same(set, within(full, window)));
        CHECK(set.outcome == full.outcome);
        CHECK(set.stats.contacts.total() == std::int64_t(set.size()));
        if (set.size() > 0 && window < 1) CHECK(set.complete_until == set.earliest()->toi + window);
        rows += int(set.size()), dropped += int(full.size() - set.size());
      }
  }
  CHECK(rows > 1000);
  CHECK(dropped > 1000);
}

TEST_CASE("a narrow window takes fewer checks", "[property]") {
  const scenes::Scene scene = scenes::sphere_onto_sphere(40, 60, 0.01, 0.5);
  const Mesh mesh(scene.x_t0, scene.faces);
  Options o;
  o.threads = 1;
  const ActiveSet full = construct_active_set(mesh, scene.x_t0, scene.x_t1, o);
  o.window = 0.001;
  const ActiveSet set = construct_active_set(mesh, scene.x_t0, scene.x_t1, o);
  REQUIRE(set.size() > 0);
  CHECK(2 * set.stats.checks < full.stats.checks);
}
