// Options::window: the earliest contacts alone, bit for bit as in the full set.
#include <cmath>
#include <cstring>
#include <onset/onset.hpp>

#include "tests/catch.hpp"
#include "tests/src/support/soups.hpp"

using namespace onset;

namespace {

template <class T>
void keep(std::vector<T>& values, const std::vector<char>& kept) {
  std::size_t next = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (kept[i]) values[next++] = values[i];
  values.resize(next);
}
template <class T>
bool same(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

ActiveSet filtered(ActiveSet set, double window) {
  if (set.size() == 0) return set;
  const double last = set.toi[std::size_t(set.earliest())] + window;
  std::vector<char> kept;
  for (const double toi : set.toi) kept.push_back(toi <= last);
  keep(set.kind, kept), keep(set.a, kept), keep(set.b, kept), keep(set.vertices, kept),
      keep(set.status, kept);
  keep(set.step_limit, kept), keep(set.weight, kept), keep(set.normal, kept), keep(set.gap, kept);
  keep(set.speed, kept), keep(set.degenerate, kept), keep(set.toi, kept);
  return set;
}
bool same_rows(const ActiveSet& a, const ActiveSet& b) {
  return same(a.kind, b.kind) && same(a.a, b.a) && same(a.b, b.b) && same(a.vertices, b.vertices) &&
         same(a.toi, b.toi) && same(a.step_limit, b.step_limit) && same(a.status, b.status) &&
         same(a.weight, b.weight) && same(a.normal, b.normal) && same(a.gap, b.gap) &&
         same(a.speed, b.speed) && same(a.degenerate, b.degenerate);
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
        CHECK(same_rows(set, filtered(full, window)));
        CHECK(set.outcome == full.outcome);
        CHECK(set.stats.contacts.total() == std::int64_t(set.size()));
        if (set.size() > 0 && window < 1)
          CHECK(set.complete_until == set.toi[std::size_t(set.earliest())] + window);
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
