// The choice between the two tests of boxes in motion.
#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "broadphase/box_test.hpp"
#include "tests/broadphase/soups.hpp"
#include "tests/catch.hpp"
#include "tests/scenes/random.hpp"

using namespace onset;
using namespace onset::tests;

namespace {

BoxTest choice(const Soup& soup) { return cheaper_box_test(soup.mesh, soup.motion()); }

// Edges of length 1 along the axes, one after the other, edge i moved by `by(i)` along x.
Soup edges(int count, const std::function<double(int)>& by) {
  Soup soup;
  soup.mesh.num_vertices = 2 * count;
  for (int i = 0; i < count; ++i) {
    soup.mesh.edges.push_back({2 * i, 2 * i + 1});
    for (int end = 0; end < 2; ++end)
      for (int a = 0; a < 3; ++a) {
        soup.x_t0.push_back(3 * i + (a == i % 3) * end);
        soup.x_t1.push_back(soup.x_t0.back() + (a == 0) * by(i));
      }
  }
  return soup;
}

double to_and_fro(int i) { return i % 2 == 0 ? 5 : -5; }

double median(std::vector<double> x) {
  std::sort(x.begin(), x.end());
  return 0.5 * x[(x.size() - 1) / 2] + 0.5 * x[x.size() / 2];
}

// By the medians of all sizes and moves.
BoxTest choice_by_medians(const Soup& soup) {
  const Motion motion = soup.motion();
  std::vector<double> size, moved[3];
  for (const auto& [v, w] : soup.mesh.edges) {
    size.push_back(0);
    for (int a = 0; a < 3; ++a) {
      size.back() = std::max(size.back(), std::fabs(motion.t0(v)[a] - motion.t0(w)[a]));
      moved[a].push_back(motion.t1(v)[a] - motion.t0(v)[a]);
    }
  }
  double sizes = 0;
  for (std::size_t i = 0; i < size.size(); ++i) {
    double most = 0;
    for (int a = 0; a < 3; ++a) most = std::max(most, std::fabs(moved[a][i] - median(moved[a])));
    sizes += std::min(most / median(size), 16.0);
  }
  return sizes > 2 * double(size.size()) ? BoxTest::moving : BoxTest::both_ends;
}

}  // namespace

TEST_CASE("the moving test is chosen where edges move by more than twice their size", "[unit]") {
  CHECK(choice(edges(300, to_and_fro)) == BoxTest::moving);
  CHECK(choice(edges(3, to_and_fro)) == BoxTest::moving);
  CHECK(choice(edges(300, [](int i) { return 0.3 * to_and_fro(i); })) == BoxTest::both_ends);
  CHECK(choice(edges(300, [](int) { return 0; })) == BoxTest::both_ends);
  CHECK(choice(edges(0, to_and_fro)) == BoxTest::both_ends);
}

TEST_CASE("what all edges have in common, and one that has flown off, decide nothing", "[unit]") {
  CHECK(choice(edges(300, [](int) { return 1000; })) == BoxTest::both_ends);
  CHECK(choice(edges(300, [](int i) { return i == 0 ? 1e9 : 0; })) == BoxTest::both_ends);
  CHECK(choice(edges(300, [](int i) { return i == 0 ? 1e9 : to_and_fro(i); })) == BoxTest::moving);
}

TEST_CASE("points of no size are left to the cheaper test", "[unit]") {
  Soup points = edges(300, to_and_fro);
  for (auto& edge : points.mesh.edges) edge[1] = edge[0];
  CHECK(choice(points) == BoxTest::both_ends);
}

TEST_CASE("the choice is the same for a scene mirrored, with axes exchanged, or of another scale",
          "[property]") {
  const auto near_the_limit = [](int i) { return i % 20 < 10 ? 0.0 : i % 20 < 18 ? 0.875 : 100.0; };
  for (const auto& by : {std::function<double(int)>(near_the_limit), std::function<double(int)>(to_and_fro)})
    for (int count : {19, 20, 300}) {
      const Soup soup = edges(count, by);
      Soup mirrored = soup, exchanged = soup;
      for (auto* x : {&mirrored.x_t0, &mirrored.x_t1})
        for (std::size_t v = 0; v < x->size(); v += 3) (*x)[v] = -(*x)[v];
      for (auto* x : {&exchanged.x_t0, &exchanged.x_t1})
        for (std::size_t v = 0; v < x->size(); v += 3) std::swap((*x)[v], (*x)[v + 2]);
      CAPTURE(count);
      CHECK(choice(mirrored) == choice(soup));
      CHECK(choice(exchanged) == choice(soup));
      for (double factor : {0x1p-1000, 0x1p1008})
        CHECK(choice(scaled(soup, "scaled", factor)) == choice(soup));
    }
}

TEST_CASE("where most edges are long beside all moves, the choice is that of the medians", "[property]") {
  scenes::Random random(57);
  int moving = 0;
  for (int i = 0; i < 2000; ++i) {
    const double far = scenes::power_of_ten(random, -0.5, 1.5);
    Soup soup =
        edges(scenes::integer(random, 1, 40), [&](int) { return scenes::uniform(random, -far, far); });
    for (std::size_t v = 1; v < soup.x_t0.size() / 3; v += 2) {  // edges of many sizes
      const double by = scenes::uniform(random, -1, 1);
      soup.x_t0[3 * v] += by, soup.x_t1[3 * v] += by;
    }
    const BoxTest by_medians = choice_by_medians(soup);
    moving += by_medians == BoxTest::moving;
    CHECK(choice(soup) == by_medians);
  }
  CHECK(moving > 200);
  CHECK(moving < 1800);
}
