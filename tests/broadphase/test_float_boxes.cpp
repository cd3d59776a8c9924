// The maps to single precision and along the curve that the tree is built on.
#include <cmath>
#include <set>

#include "base/hilbert_table.hpp"
#include "broadphase/bvh/float_boxes.hpp"
#include "broadphase/bvh/space_curve.hpp"
#include "tests/broadphase/candidates.hpp"
#include "tests/broadphase/soups.hpp"
#include "tests/catch.hpp"

using namespace onset;
using namespace onset::tests;

TEST_CASE("the map to single precision keeps the order of coordinates", "[property]") {
  for (const Soup& soup : hard_soups()) {
    const Motion motion = soup.motion();
    const FloatMap map(motion);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::vector<double> x{-0x1p1020, 0x1p1020, 0.0};
      for (int v = 0; v < motion.num_vertices; ++v)
        for (double value : {motion.t0(v)[axis], motion.t1(v)[axis]})
          x.insert(x.end(), {value, std::nextafter(value, 1e308), std::nextafter(value, -1e308)});
      std::sort(x.begin(), x.end());
      for (std::size_t i = 1; i < x.size(); ++i) {
        const float a = map(x[i - 1], axis), b = map(x[i], axis);
        if (!(std::isfinite(a) && a <= b)) FAIL_CHECK(soup.name << ": " << x[i - 1] << " " << x[i]);
        if (x[i - 1] < x[i] && a == b && map.inverts(a, x[i - 1], axis) && map.inverts(b, x[i], axis))
          FAIL_CHECK(soup.name << ": not one to one, " << x[i - 1] << " " << x[i]);
      }
    }
  }
}

TEST_CASE("the map tells the vertices of two small clusters apart, however far they are", "[property]") {
  scenes::Random random(43);
  for (double apart : {1e3, 1e7, 1e9, 1e12}) {
    Soup soup = scattered("clusters", 1000, 0.1, 0.1, random);
    for (auto* x : {&soup.x_t0, &soup.x_t1})
      for (std::size_t i = x->size() / 2; i < x->size(); ++i) (*x)[i] += apart;
    const Motion motion = soup.motion();
    const FloatMap map(motion);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::set<double> exact;
      std::set<float> mapped;
      for (int v = 0; v < motion.num_vertices; ++v)
        exact.insert(motion.t0(v)[axis]), mapped.insert(map(motion.t0(v)[axis], axis));
      CHECK(mapped.size() > exact.size() * 9 / 10);
    }
  }
}

TEST_CASE("boxes one unit in the last place apart in double are not candidates, touching ones are",
          "[unit]") {
  for (double x : {0.1, 1 / 3.0, 1e6 + 0.1, 1e15 + 0.125})
    for (int apart : {-1, 0, 1}) {
      Soup soup;  // two edges that meet, or not, in the plane x
      soup.mesh.num_vertices = 4;
      soup.mesh.edges = {{0, 1}, {2, 3}};
      const double next = apart == 0 ? x : std::nextafter(x, apart * 1e300);
      soup.x_t0 = {x - 1, 0, 0, x, 0, 0, next, 0, 0, x + 1, 0, 0};
      soup.x_t1 = soup.x_t0;
      const Motion motion = soup.motion();
      for (const Method& m : methods())
        for (BoxTest test : {BoxTest::swept, BoxTest::both_ends, BoxTest::moving}) {
          BroadPhaseInput input{soup.mesh, motion};
          input.test = test, input.instruction_set = m.instruction_set;
          INFO(m.name << " x " << x << " apart " << apart);
          CHECK(candidates(*make_broad_phase(m.method, input), PairKind::edge_edge).size() ==
                (apart > 0 ? 0u : 1u));
        }
    }
}

TEST_CASE("the Hilbert curve visits every cell once and moves by one cell at a time", "[unit]") {
  constexpr std::uint32_t n = 32;  // the first cells of the curve: a cube at the origin
  std::vector<int> place(n * n * n, -1);
  for (std::uint32_t z = 0; z < n; ++z)
    for (std::uint32_t y = 0; y < n; ++y)
      for (std::uint32_t x = 0; x < n; ++x) {
        const std::uint32_t key = hilbert_key(x, y, z);
        REQUIRE(key < n * n * n);
        REQUIRE(place[key] == -1);
        place[key] = int(x + n * (y + n * z));
      }
  for (std::size_t i = 1; i < place.size(); ++i) {
    const int a = place[i - 1], b = place[i], m = int(n);
    const int steps =
        std::abs(a % m - b % m) + std::abs(a / m % m - b / m % m) + std::abs(a / m / m - b / m / m);
    REQUIRE(steps == 1);
  }
}

TEST_CASE("in each state the Hilbert curve goes through the eight octants by their faces", "[unit]") {
  const HilbertTable table = make_hilbert_table();
  for (const std::array<std::uint8_t, 8>& state : table.next) {
    std::array<int, 8> octant;
    octant.fill(-1);
    for (int o = 0; o < 8; ++o) {
      CHECK(state[std::size_t(o)] / 8 < int(table.next.size()));
      octant[std::size_t(state[std::size_t(o)] % 8)] = o;
    }
    for (std::size_t place = 0; place < 8; ++place) REQUIRE(octant[place] >= 0);
    for (std::size_t place = 1; place < 8; ++place) {
      const int changed = octant[place - 1] ^ octant[place];
      CHECK((changed == 1 || changed == 2 || changed == 4));
    }
  }
}

TEST_CASE("the order along the curve is a permutation, and outliers do not spoil it", "[unit]") {
  scenes::Random random(41);
  constexpr std::size_t n = 20000;
  std::vector<float> points;
  for (std::size_t i = 0; i < 3 * n; ++i) points.push_back(float(scenes::uniform(random, -1, 1)));
  const auto length = [&](const std::vector<int>& order) {  // of the way through all points but the last
    double sum = 0;
    for (std::size_t i = 1, previous = std::size_t(order[0]); i < n; ++i) {
      const std::size_t p = std::size_t(order[i]);
      if (p == n - 1 || previous == n - 1) {
        previous = p;
        continue;
      }
      double square = 0;
      for (std::size_t a = 0; a < 3; ++a)
        square += std::pow(double(points[3 * p + a]) - points[3 * previous + a], 2);
      sum += std::sqrt(square);
      previous = p;
    }
    return sum;
  };
  std::vector<int> order(n);
  order_along_curve(points.data(), n, order.data());
  CHECK(std::set<int>(order.begin(), order.end()).size() == n);
  const double without = length(order);
  CHECK(without < n * 0.1);  // random order: about 1.3 a step
  points[3 * n - 3] = 1e30f;
  order_along_curve(points.data(), n, order.data());
  CHECK(std::set<int>(order.begin(), order.end()).size() == n);
  CHECK(length(order) < 1.1 * without);
}
