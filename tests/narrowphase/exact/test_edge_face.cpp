// What an edge and a face at rest have in common, against exact arithmetic by another method.
#include <algorithm>
#include <cmath>

#include "narrowphase/at_rest/edge_face.hpp"
#include "narrowphase/exact/exact.hpp"
#include "tests/catch.hpp"
#include "tests/oracle/arithmetic/rational.hpp"
#include "tests/oracle/edge_face.hpp"
#include "tests/oracle/promises.hpp"
#include "tests/scenes/random.hpp"

using namespace onset;
using oracle::Rational;
using oracle::operator-;
using scenes::Random;

namespace {

using Kind = std::optional<IntersectionKind>;
using Points = std::array<Point, 5>;  // e0, e1, f0, f1, f2

constexpr Kind kApart{}, kCrossing{IntersectionKind::crossing}, kTouching{IntersectionKind::touching},
    kOverlapping{IntersectionKind::overlapping};

Kind answer(const Points& x) {
  const EdgeFace found = edge_face({{x[0].data(), x[1].data()}, {x[2].data(), x[3].data(), x[4].data()}});
  switch (found) {
    case EdgeFace::crossing:
      return kCrossing;
    case EdgeFace::touching:
      return kTouching;
    case EdgeFace::overlapping:
      return kOverlapping;
    default:
      return kApart;
  }
}

template <class Q>
Kind truth(const Points& x) {
  const auto at = [&](std::size_t i) {
    return oracle::Vector<Q>{static_cast<Q>(x[i][0]), static_cast<Q>(x[i][1]), static_cast<Q>(x[i][2])};
  };
  return oracle::edge_face<Q>({at(0), at(1)}, {at(2), at(3), at(4)});
}

std::string text(const Points& x) {
  std::string s;
  char number[40];
  for (const Point& p : x)
    for (const double c : p) std::snprintf(number, sizeof number, "%a ", c), s += number;
  return s;
}

// The answer does not depend on which end or corner comes first, nor on the order of the axes.
void check_all_orders(const Points& x, const Kind& expected) {
  INFO(text(x));
  std::array<std::size_t, 3> f{2, 3, 4};
  do {
    const std::size_t a = f[0] - 2, b = f[1] - 2, c = f[2] - 2;
    Points y{x[0], x[1], x[f[0]], x[f[1]], x[f[2]]};
    for (Point& p : y) p = {p[a], p[b], p[c]};
    CHECK((answer(y) == expected));
    std::swap(y[0], y[1]);
    CHECK((answer(y) == expected));
  } while (std::next_permutation(f.begin(), f.end()));
}

Points grid_points(Random& random, int size) {
  Points x;
  for (Point& p : x)
    for (double& c : p) c = scenes::integer(random, -size, size);
  return x;
}

// Kinds are affine: scaled by a power of two along each axis, all the same in half of the cases, and moved
// where that is exact.
Points moved(Points x, Random& random) {
  const int low = scenes::integer(random, 0, 2), high = scenes::integer(random, 0, 2);
  const int least[] = {-1074, -300, -30}, most[] = {0, 290, 1016};
  const bool same = scenes::coin(random);
  int exponent = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    if (a == 0 || !same) exponent = scenes::integer(random, least[low], most[high]);
    const double offset =
        scenes::coin(random) ? 0 : scenes::integer(random, -1000000000, 1000000000) * 0x1p19;
    const bool room = exponent + 51 < 1020;
    for (Point& p : x) p[a] = std::ldexp(p[a] + (room ? offset : 0), exponent);
  }
  return x;
}

}  // namespace

TEST_CASE("an edge and a face: every way to meet, by hand", "[unit]") {
  const Point f0{0, 0, 0}, f1{4, 0, 0}, f2{0, 4, 0};
  const auto with = [&](const Point& e0, const Point& e1, const Kind& expected) {
    check_all_orders({e0, e1, f0, f1, f2}, expected);
    CHECK((truth<Rational>({e0, e1, f0, f1, f2}) == expected));
  };
  with({1, 1, -1}, {1, 1, 1}, kCrossing);
  with({1, 1, 0}, {1, 1, 1}, kTouching);      // an end on the face
  with({2, 2, -1}, {2, 2, 1}, kTouching);     // through a side
  with({4, 0, -1}, {4, 0, 1}, kTouching);     // through a corner
  with({4, 0, 0}, {5, 0, 1}, kTouching);      // an end at a corner
  with({1, 1, 1}, {1, 1, 2}, kApart);         // above
  with({3, 3, -1}, {3, 3, 1}, kApart);        // past a side
  with({5, 0, -1}, {5, 0, 1}, kApart);        // on the line of a side
  with({1, 1, 0}, {2, 1, 0}, kOverlapping);   // within
  with({-1, 1, 0}, {5, 1, 0}, kOverlapping);  // across
  with({-1, 0, 0}, {1, 0, 0}, kOverlapping);  // along a side
  with({-2, 0, 0}, {0, 0, 0}, kTouching);     // in the line of a side, up to a corner
  with({-1, 1, 0}, {1, -1, 0}, kTouching);    // in the plane, past a corner
  with({-1, -1, 0}, {1, -1, 0}, kApart);      // in the plane, beside
  with({4, 4, 0}, {2, 2, 0}, kTouching);      // in the plane, up to a side
  with({1, 1, 0}, {1, 1, 0}, kTouching);      // points
  with({2, 2, 0}, {2, 2, 0}, kTouching);
  with({3, 3, 0}, {3, 3, 0}, kApart);
  with({1, 1, 1}, {1, 1, 1}, kApart);
}

TEST_CASE("an edge and a face without area: the segment or point that it is, by hand", "[unit]") {
  const auto with = [](const Points& x, const Kind& expected) {
    check_all_orders(x, expected);
    CHECK((truth<Rational>(x) == expected));
  };
  with({{{1, -1, 0}, {1, 1, 0}, {0, 0, 0}, {2, 0, 0}, {4, 0, 0}}}, kTouching);
  with({{{5, -1, 0}, {5, 1, 0}, {0, 0, 0}, {2, 0, 0}, {4, 0, 0}}}, kApart);
  with({{{1, -1, 1}, {1, 1, 1}, {0, 0, 0}, {2, 0, 0}, {4, 0, 0}}}, kApart);
  with({{{1, 0, 0}, {7, 0, 0}, {0, 0, 0}, {2, 0, 0}, {4, 0, 0}}}, kOverlapping);
  with({{{4, 0, 0}, {7, 0, 0}, {0, 0, 0}, {2, 0, 0}, {4, 0, 0}}}, kTouching);
  with({{{5, 0, 0}, {7, 0, 0}, {0, 0, 0}, {2, 0, 0}, {4, 0, 0}}}, kApart);
  with({{{1, 1, 0}, {7, 1, 0}, {0, 0, 0}, {2, 0, 0}, {4, 0, 0}}}, kApart);  // parallel
  with({{{3, 0, 0}, {3, 0, 0}, {0, 0, 0}, {4, 0, 0}, {4, 0, 0}}}, kTouching);
  with({{{0, 0, 0}, {2, 2, 2}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}}}, kTouching);
  with({{{0, 0, 0}, {2, 2, 2}, {1, 1, 2}, {1, 1, 2}, {1, 1, 2}}}, kApart);
  with({{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}}}, kTouching);
  with({{{-0.0, 1, 1}, {-0.0, 1, 1}, {0.0, 1, 1}, {0.0, 1, 1}, {0.0, 1, 1}}}, kTouching);
}

TEST_CASE("edges and faces on small grids, scaled and moved from subnormal numbers to 2^1019",
          "[oracle][property]") {
  Random random(70 + oracle::fuzz_seed());
  int counts[4] = {};
  for (int i = 0; i < oracle::fuzz(120000); ++i) {
    const Points x = grid_points(random, 1 + i % 4);
    const Kind expected = truth<std::int64_t>(x);
    ++counts[expected ? 1 + int(*expected) : 0];
    const Points y = moved(x, random);
    INFO(text(y));
    REQUIRE((answer(x) == expected));
    REQUIRE((answer(y) == expected));
    if (i % 64 == 0) check_all_orders(y, expected);
  }
  for (const int n : counts) CHECK(n > oracle::fuzz(400));
}

// A point of the segment or face, up to rounding: on it, or beside it by the last bits.
TEST_CASE("edges and faces that touch up to the last bits", "[oracle][property]") {
  Random random(71 + oracle::fuzz_seed());
  int counts[4] = {};
  for (int i = 0; i < oracle::fuzz(12000); ++i) {
    Points x;
    const double size = scenes::power_of_ten(random, -3, 3),
                 offset = i % 3 == 0 ? 0 : scenes::power_of_ten(random, -2, 6);
    for (Point& p : x) {
      p = scenes::point(random, size);
      for (double& c : p) c += offset;
    }
    const auto between = [&](const Point& p, const Point& q, double t) {
      return Point{p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]), p[2] + t * (q[2] - p[2])};
    };
    const Point side = between(x[2], x[3], scenes::unit(random)),
                inside = between(side, x[4], scenes::unit(random));
    switch (i % 6) {
      case 0:
        x[0] = inside;
        break;  // an end on the face
      case 1:
        x[0] = side;
        break;  // an end on a side
      case 2:
        x[0] = between(x[1], side, 2);
        break;  // through a side
      case 3:
        x[0] = inside, x[1] = between(inside, side, 3);
        break;  // in the plane
      case 4:
        x[4] = between(x[2], x[3], scenes::uniform(random, -1, 2)), x[0] = side;
        break;  // no area
      default:
        x[0] = between(x[2], x[3], 2), x[1] = side;
        break;  // in the line of a side
    }
    const Kind expected = truth<Rational>(x);
    ++counts[expected ? 1 + int(*expected) : 0];
    INFO(text(x));
    REQUIRE((answer(x) == expected));
  }
  CHECK(counts[0] > oracle::fuzz(1000));
  CHECK(counts[1] > oracle::fuzz(1000));
}

// In their plane exactly, in integers whose products round: the directions that could separate them are off
// by rounding.
TEST_CASE("edges that reach the side of a face in its plane", "[oracle][property]") {
  Random random(75 + oracle::fuzz_seed());
  int touching = 0;
  for (int i = 0; i < oracle::fuzz(10000); ++i) {
    const int bits = scenes::integer(random, 4, 40);
    const Point v = scenes::grid_point(random, bits), w = scenes::grid_point(random, bits),
                f0 = scenes::grid_point(random, bits + 8);
    const auto at = [&](double s, double t) {
      return Point{f0[0] + s * v[0] + t * w[0], f0[1] + s * v[1] + t * w[1], f0[2] + s * v[2] + t * w[2]};
    };
    const double s = scenes::integer(random, -1, 9), beyond = scenes::integer(random, 0, 5);
    const Points x{at(s, 0), at(scenes::integer(random, -9, 9), -beyond), f0, at(8, 0),
                   at(scenes::integer(random, -9, 9), 7)};
    const Kind expected = truth<Rational>(x);
    touching += expected == kTouching;
    INFO(text(x));
    REQUIRE((answer(x) == expected));
  }
  CHECK(touching > oracle::fuzz(2000));
}

// Inner products that underflow or overflow, where the whole does not.
TEST_CASE("edges and faces of very different sizes", "[oracle][property]") {
  Random random(76 + oracle::fuzz_seed());
  int counts[4] = {};
  for (int i = 0; i < oracle::fuzz(6000); ++i) {
    Points x = grid_points(random, 3);
    const int of_face = i % 2 == 0 ? scenes::integer(random, -545, -525) : scenes::integer(random, 507, 511);
    const int of_edge = scenes::integer(random, -1074, 1000), shift = scenes::coin(random) ? 0 : of_face;
    for (std::size_t k = 0; k < 5; ++k)
      for (double& c : x[k]) c = std::ldexp(c, k < 2 ? of_edge : of_face);
    for (std::size_t k = 0; k < 2; ++k)
      for (double& c : x[k]) c += shift == 0 ? 0 : std::ldexp(scenes::integer(random, -3, 3), shift);
    if (scenes::coin(random)) x[2] = {0, 0, 0};
    if (scenes::coin(random)) x[1] = {-x[0][0], -x[0][1], -x[0][2]};
    const Kind expected = truth<Rational>(x);
    ++counts[expected ? 1 + int(*expected) : 0];
    INFO(text(x));
    REQUIRE((answer(x) == expected));
  }
  for (const int n : counts) CHECK(n > 0);
}

// One component of the normal is infinite, and not the one that decides.
TEST_CASE("an edge through a face whose normal overflows", "[unit]") {
  const double big = 0x1p509, small = 0x1p-10;
  const Points x{{{small, 3 * small, 14 * small},
                  {small, -3 * small, 14 * small},
                  {0, 0, 0},
                  {-3 * big, 7 * big, 7 * big},
                  {4 * big, -7 * big, 7 * big}}};
  CHECK((truth<Rational>(x) == kCrossing));
  check_all_orders(x, kCrossing);
}

TEST_CASE("edges and faces whose coordinates span all binary orders", "[oracle][property]") {
  Random random(72 + oracle::fuzz_seed());
  int meeting = 0;
  for (int i = 0; i < oracle::fuzz(2000); ++i) {
    Points x = grid_points(random, 2);
    for (Point& p : x)
      for (double& c : p)
        if (scenes::integer(random, 0, 3) == 0) c = std::ldexp(c, scenes::integer(random, -1074, 1018));
    INFO(text(x));
    const Kind expected = truth<Rational>(x);
    meeting += expected.has_value();
    REQUIRE((answer(x) == expected));
  }
  CHECK(meeting > oracle::fuzz(20));
}

TEST_CASE("pairs at rest touch exactly where points and segments on one place do", "[oracle][property]") {
  Random random(73 + oracle::fuzz_seed());
  int touching = 0;
  for (int i = 0; i < oracle::fuzz(20000); ++i) {
    const Points x = moved(grid_points(random, 1 + i % 3), random);
    const double* p[4] = {x[0].data(), x[1].data(), x[2].data(), x[3].data()};
    const ExactPair vf{PairKind::vertex_face, {p[0], p[1], p[2], p[3]}, {p[0], p[1], p[2], p[3]}};
    const ExactPair ee{PairKind::edge_edge, {p[0], p[1], p[2], p[3]}, {p[0], p[1], p[2], p[3]}};
    INFO(text(x));
    const bool on_face = answer({x[0], x[0], x[1], x[2], x[3]}).has_value();
    const bool on_edge = answer({x[0], x[1], x[2], x[3], x[3]}).has_value();
    REQUIRE(exactly_touches(vf) == on_face);
    REQUIRE(exactly_touches(ee) == on_edge);
    touching += on_face + on_edge;
  }
  CHECK(touching > oracle::fuzz(1000));
}

TEST_CASE("three points on one line, up to the last bits", "[oracle][property]") {
  Random random(74 + oracle::fuzz_seed());
  int collinear = 0;
  for (int i = 0; i < oracle::fuzz(20000); ++i) {
    Points x = moved(grid_points(random, 1 + i % 3), random);
    if (i % 2 == 0) {
      for (std::size_t k : {2, 3}) x[k] = scenes::point(random, 1e3);
      for (std::size_t a = 0; a < 3; ++a)
        x[4][a] = x[2][a] + (i % 4 == 0 ? 2 : 1.0 / 3) * (x[3][a] - x[2][a]);
    }
    const auto at = [&](std::size_t k) { return oracle::Vector<Rational>{x[k][0], x[k][1], x[k][2]}; };
    const bool expected =
        oracle::cross<Rational>(at(3) - at(2), at(4) - at(2)) == oracle::Vector<Rational>{0, 0, 0};
    INFO(text(x));
    REQUIRE(exactly_collinear(x[2].data(), x[3].data(), x[4].data()) == expected);
    collinear += expected;
  }
  CHECK(collinear > oracle::fuzz(500));
}
