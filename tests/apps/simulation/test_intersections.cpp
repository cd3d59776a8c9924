// The exact check of the simulators finds what it is there to find.
#include "simulation/intersections.hpp"
#include "tests/catch.hpp"

namespace {

using Faces = std::vector<std::array<int, 3>>;

simulation::Vector points(std::vector<double> x) {
  return Eigen::Map<simulation::Vector>(x.data(), Eigen::Index(x.size()));
}

bool meet(const std::vector<double>& x, const Faces& faces) {
  return simulation::faces_that_meet(points(x), faces).has_value();
}

}  // namespace

TEST_CASE("faces without a common vertex", "[unit]") {
  const Faces two{{0, 1, 2}, {3, 4, 5}};
  const auto needle = [](double tip) {
    return std::vector<double>{0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, tip, 1.5, 1, 3, 1, 1.5, 3};
  };
  CHECK(meet(needle(-0.5), two));
  CHECK(meet(needle(0), two));  // touching
  CHECK_FALSE(meet(needle(1e-300), two));
}

TEST_CASE("faces with a common vertex", "[unit]") {
  const Faces fan{{0, 1, 2}, {0, 3, 4}};
  CHECK(meet({0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, -1, 1, 1, 1}, fan));
  CHECK_FALSE(meet({0, 0, 0, 4, 0, 0, 0, 4, 0, -1, -1, -1, -1, -1, 1}, fan));
}

TEST_CASE("faces with a common edge", "[unit]") {
  const Faces hinge{{0, 1, 2}, {1, 0, 3}};
  CHECK(meet({0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 3, 0}, hinge));  // folded flat
  CHECK_FALSE(meet({0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 3, 1e-9}, hinge));
  CHECK_FALSE(meet({0, 0, 0, 4, 0, 0, 0, 4, 0, 1, -3, 0}, hinge));
}

TEST_CASE("vertices and planes", "[unit]") {
  const std::vector<onset::Plane> ground{{{0, 0, 1}, 0}}, tilted{{{0.1, 0.2, 0.7}, 0.3}};
  const auto behind = [](std::vector<double> x, const std::vector<onset::Plane>& planes) {
    return simulation::vertex_behind_plane(points(std::move(x)), planes).has_value();
  };
  CHECK_FALSE(behind({0, 0, 1, 5, 5, 5e-324}, ground));
  CHECK(behind({0, 0, 1, 5, 5, 0}, ground));
  CHECK(behind({0, 0, 1, 5, 5, -5e-324}, ground));
  CHECK_FALSE(behind({0, 0, -1}, {}));
  // 0.1 + 0.2 of doubles is more than 0.3, exactly.
  CHECK_FALSE(behind({1, 1, 0}, tilted));
  CHECK(behind({1, 1, -1e-16}, tilted));
}
