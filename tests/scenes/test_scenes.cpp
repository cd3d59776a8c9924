// The generators themselves: seeds repeat, coordinates are in range, closed surfaces are closed.
#include <Eigen/LU>
#include <map>

#include "onset/mesh.hpp"
#include "tests/catch.hpp"
#include "tests/scenes/families.hpp"
#include "tests/scenes/meshes.hpp"

using namespace onset;
using namespace onset::scenes;

TEST_CASE("a seed means the same query, of coordinates in range", "[unit]") {
  for (const Family& family : families())
    for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
      Random first = seeded(family, kind, 3), second = seeded(family, kind, 3),
             other = seeded(family, kind, 4);
      int different = 0;
      for (int i = 0; i < 50; ++i) {
        const Query query = family.make(kind, first);
        INFO(family.name << " " << to_text(query));
        CHECK(query.kind == kind);
        CHECK(to_text(query) == to_text(family.make(kind, second)));
        different += to_text(query) != to_text(family.make(kind, other));
        for (const auto& points : {query.t0, query.t1})
          for (const Point& p : points)
            for (double x : p) CHECK(std::abs(x) <= 0x1p1020);  // false for NaN
      }
      CHECK(different > 40);
    }
}

static double volume(const Scene& scene) {
  double sum = 0;
  for (Eigen::Index f = 0; f < scene.faces.rows(); ++f) {
    Eigen::Matrix3d m;
    for (int k = 0; k < 3; ++k) m.row(k) = scene.x_t0.row(scene.faces(f, k));
    sum += m.determinant() / 6;
  }
  return sum;
}

// Every directed side once, and once the other way round.
static bool closed(const Scene& scene) {
  std::map<std::pair<int, int>, int> sides;
  for (Eigen::Index f = 0; f < scene.faces.rows(); ++f)
    for (int k = 0; k < 3; ++k) ++sides[{scene.faces(f, k), scene.faces(f, (k + 1) % 3)}];
  for (const auto& [side, count] : sides) {
    const auto back = sides.find({side.second, side.first});
    if (count != 1 || back == sides.end() || back->second != 1) return false;
  }
  return true;
}

TEST_CASE("spheres and cubes are closed and face outward", "[unit]") {
  CHECK(closed(cube()));
  CHECK(volume(cube()) == 8);
  for (int rings : {2, 5, 20})
    for (int segments : {3, 7, 30}) {
      const Scene ball = sphere(rings, segments);
      CHECK(closed(ball));
      CHECK(ball.x_t0.rows() == rings * segments + 2);
      CHECK(ball.faces.maxCoeff() == ball.x_t0.rows() - 1);
      CHECK(volume(ball) > 0);
      for (Eigen::Index v = 0; v < ball.x_t0.rows(); ++v)
        CHECK(std::abs(ball.x_t0.row(v).norm() - 1) < 1e-15);
    }
  CHECK(std::abs(volume(sphere(60, 60)) - 4.18879) < 0.02);
  const Scene two = sphere_onto_sphere(6, 8, 0.1, 0.2);
  CHECK(closed(two));
  CHECK(two.x_t0.rows() == 100);
  CHECK((two.x_t1 - two.x_t0).topRows(50).col(0).maxCoeff() < -0.1999);
  CHECK((two.x_t1 - two.x_t0).bottomRows(50).isZero(0));
}

TEST_CASE("a cloth has the edges of its grid, a soup no shared vertex", "[unit]") {
  const Scene sheet = cloth(5, 7);
  CHECK(sheet.x_t0.rows() == 35);
  CHECK(sheet.faces.rows() == 48);
  CHECK(edge_list(sheet.faces).size() == 5 * 6 + 4 * 7 + 4 * 6);
  Random random(1);
  const Scene soup = triangle_soup(40, 0.1, 0.05, random);
  CHECK(edge_list(soup.faces).size() == 120);
  CHECK((soup.x_t1 - soup.x_t0).cwiseAbs().maxCoeff() <= 0.05);
  CHECK((soup.x_t1 - soup.x_t0).cwiseAbs().maxCoeff() > 0.04);
}
