// The choice between the two tests of boxes in motion.
#include <functional>

#include "broadphase/box_test.hpp"
#include "tests/broadphase/soups.hpp"
#include "tests/catch.hpp"

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
