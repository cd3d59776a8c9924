// The step's shrunk t_max: bit for bit the minimum of the active set.
#include <algorithm>
#include <cmath>
#include <onset/onset.hpp>

#include "tests/catch.hpp"
#include "tests/src/support/soups.hpp"

using namespace onset;

namespace {

bool any_parts(const ActiveSet& set) {
  return std::any_of(set.begin(), set.end(),
                     [](const Contact& c) { return c.outcome == PairOutcome::initial_separating; });
}
std::vector<std::array<int, 4>> vertices_of(const ActiveSet& set) {
  std::vector<std::array<int, 4>> all;
  for (const Contact& contact : set) all.push_back(contact.vertices);
  return all;
}

}  // namespace

TEST_CASE("the step is the active set's earliest toi, for every seed, size and separation", "[property]") {
  int contacts = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const auto [soup, mesh, options] = tests::soup(seed, 20 + int(seed) * 10);
    const ActiveSet set = construct_active_set(mesh, soup.x_t0, soup.x_t1, options);
    const StepResult step = compute_collision_free_stepsize(mesh, soup.x_t0, soup.x_t1, options);
    double earliest = 1;
    for (std::size_t i = 0; i < set.size(); ++i)
      if (set[i].outcome != PairOutcome::initial_separating) earliest = std::min(earliest, set[i].toi);
    contacts += earliest < 1;
    if (!any_parts(set)) REQUIRE((step.toi == earliest || (earliest == 1 && step.toi == INFINITY)));
  }
  CHECK(contacts > 20);
}

TEST_CASE("exact: the step is the earliest contact between adjacent doubles, at any tolerance",
          "[property]") {
  int contacts = 0;
  for (unsigned seed = 1; seed <= 16; ++seed) {
    auto [soup, mesh, options] = tests::soup(seed, 20 + int(seed) * 20);
    options.min_separation = 0;
    options.exactness = Exactness::exact;
    StepResult first;
    std::vector<std::array<int, 4>> found;
    for (double tolerance : {1e-2, 1e-6, 1e-10}) {
      options.relative_tolerance = tolerance;
      options.threads = tolerance == 1e-6 ? 2 : 1;
      const StepResult step = compute_collision_free_stepsize(mesh, soup.x_t0, soup.x_t1, options);
      const ActiveSet set = construct_active_set(mesh, soup.x_t0, soup.x_t1, options);
      if (tolerance == 1e-2) first = step, found = vertices_of(set);
      REQUIRE(step.toi == first.toi);
      REQUIRE(step.toi_hi == first.toi_hi);
      REQUIRE(step.outcome == first.outcome);
      REQUIRE(step.limiting.has_value() == first.limiting.has_value());
      if (step.limiting) REQUIRE(step.limiting->vertices == first.limiting->vertices);
      REQUIRE(vertices_of(set) == found);
      REQUIRE((step.outcome == Outcome::free) == (set.size() == 0));
      REQUIRE(is_step_collision_free(mesh, soup.x_t0, soup.x_t1, options) == (set.size() == 0));
      if (set.size() == 0 || any_parts(set)) continue;
      const Contact& earliest = *set.earliest();
      REQUIRE(earliest.toi == step.toi);
      REQUIRE(earliest.toi_hi == step.toi_hi);
      REQUIRE((step.toi_hi == step.toi || step.toi_hi == std::nextafter(step.toi, 2)));
      ++contacts;
    }
  }
  CHECK(contacts > 15);
}

namespace {

// Triangles, three rows each.
struct Triangles {
  std::vector<double> x_t0, x_t1;
  void add(const std::array<double, 3>& a, const std::array<double, 3>& b, const std::array<double, 3>& c,
           const std::array<double, 3>& by) {
    for (const auto& p : {a, b, c})
      for (std::size_t i = 0; i < 3; ++i) x_t0.push_back(p[i]), x_t1.push_back(p[i] + by[i]);
  }
  // Of a vertex at 0.3, of two pairs of edges later.
  void add_contact() {
    add({5, 5, 0}, {6, 5, 0}, {5, 6, 0}, {0, 0, 0});
    add({5.2, 5.2, 0.3}, {6.2, 5.2, 0.4}, {5.2, 6.2, 0.5}, {0, 0, -1});
  }
  std::ptrdiff_t vertices() const { return std::ptrdiff_t(x_t0.size() / 3); }
  void expect_same_earliest(std::size_t contacts) const {
    Eigen::MatrixXi faces(vertices() / 3, 3);
    for (int f = 0; f < faces.rows(); ++f) faces.row(f) << 3 * f, 3 * f + 1, 3 * f + 2;
    const Positions begin(x_t0.data(), vertices()), end(x_t1.data(), vertices());
    const Mesh mesh(begin, faces);
    for (const BroadPhaseMethod method :
         {BroadPhaseMethod::brute, BroadPhaseMethod::bvh, BroadPhaseMethod::hash}) {
      Options options;
      options.broad_phase = method;
      options.exactness = Exactness::conservative;  // reports what is within the tolerance
      const ActiveSet set = construct_active_set(mesh, begin, end, options);
      const StepResult step = compute_collision_free_stepsize(mesh, begin, end, options);
      REQUIRE(set.size() == contacts);
      const double earliest = set.earliest()->toi;
      CHECK(step.toi == earliest);
      options.window = 0.01;
      const ActiveSet first = construct_active_set(mesh, begin, end, options);
      REQUIRE(first.size() == 1);
      CHECK(first[0].toi == earliest);
    }
  }
};

}  // namespace

TEST_CASE("pairs that pass within the tolerance, boxes never together, stay out of active set and step",
          "[regression]") {
  for (double gap : {0x1p-41, 0x1p-40, 0x1p-39}) {
    Triangles scene;
    scene.add_contact();
    for (int i = 0; i < 30;
         ++i) {  // posts that fly by one another, corner to corner, and make the usual motion long
      const double x = 10 * i;
      scene.add({x, 0, 20}, {x, 0, 20.5}, {x, 0, 20.25}, {0, 0, 0});
      scene.add({x - 2, 2 + gap, 20.1}, {x - 2, 2 + gap, 20.6}, {x - 2, 2 + gap, 20.3}, {16, -16, 0});
    }
    CAPTURE(gap);
    scene.expect_same_earliest(3);
  }
}
