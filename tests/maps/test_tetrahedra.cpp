// The surface of tetrahedra: closed, outward, and with the vertices that it uses.
#include <Eigen/Geometry>
#include <map>
#include <onset/tetrahedra.hpp>
#include <random>

#include "tests/catch.hpp"
#include "tests/scenes/random.hpp"

using namespace onset;
using Eigen::MatrixXd;
using Eigen::MatrixXi;

namespace {

// n^3 cubes of six tetrahedra each, all of which share the diagonal of their cube. Positive.
struct Block {
  MatrixXd x;
  MatrixXi T;
  explicit Block(int n) : x((n + 1) * (n + 1) * (n + 1), 3), T(6 * n * n * n, 4) {
    const auto id = [n](int i, int j, int k) { return (i * (n + 1) + j) * (n + 1) + k; };
    int row = 0;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j)
        for (int k = 0; k <= n; ++k) x.row(id(i, j, k)) << i, j, k;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        for (int k = 0; k < n; ++k)
          for (const auto& path :
               {std::array<int, 3>{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {0, 2, 1}, {2, 1, 0}}) {
            int at[3] = {i, j, k}, corner[4];
            for (int step = 0; step < 4; ++step) {
              corner[step] = id(at[0], at[1], at[2]);
              if (step < 3) ++at[path[std::size_t(step)]];
            }
            T.row(row) << corner[0], corner[1], corner[2], corner[3];
            if (volume(T.row(row)) < 0) std::swap(T(row, 2), T(row, 3));
            ++row;
          }
  }
  double volume(const Eigen::RowVector4i& t) const {
    const Eigen::RowVector3d a = x.row(t[1]) - x.row(t[0]), b = x.row(t[2]) - x.row(t[0]),
                             c = x.row(t[3]) - x.row(t[0]);
    return a.cross(b).dot(c) / 6;
  }
};

double enclosed(const TetrahedraSurface& s, const MatrixXd& x) {
  double volume = 0;
  for (const auto& f : s.faces) {
    const auto at = [&](std::size_t c) -> Eigen::RowVector3d {
      return x.row(s.full_vertices[std::size_t(f[c])]);
    };
    volume += at(0).cross(at(1)).dot(at(2)) / 6;
  }
  return volume;
}

// Every edge of a face is that of one other face, run through the other way.
bool is_closed(const TetrahedraSurface& s) {
  std::map<std::array<int, 2>, int> runs;
  for (const auto& f : s.faces)
    for (std::size_t c = 0; c < 3; ++c) ++runs[{f[c], f[(c + 1) % 3]}];
  for (const auto& [edge, count] : runs)
    if (count != 1 || runs.count({edge[1], edge[0]}) == 0) return false;
  return true;
}

std::string refusal(const MatrixXi& T, std::ptrdiff_t vertices) {
  try {
    surface_of_tetrahedra(T, vertices);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "";
}

}  // namespace

TEST_CASE("the surface of a block of tetrahedra is closed, outward, and without what is inside", "[unit]") {
  for (int n = 1; n <= 4; ++n) {
    const Block block(n);
    const TetrahedraSurface s = surface_of_tetrahedra(block.T, block.x.rows());
    CHECK(s.faces.size() == std::size_t(12 * n * n));
    CHECK(s.edges.size() == std::size_t(18 * n * n));
    CHECK(s.full_vertices.size() == std::size_t(6 * n * n + 2));
    CHECK(is_closed(s));
    CHECK(std::fabs(enclosed(s, block.x) - n * n * n) < 1e-12);
    for (std::size_t v = 0; v < s.full_vertices.size(); ++v)
      CHECK(s.surface_vertices[std::size_t(s.full_vertices[v])] == int(v));
    const Mesh mesh = s.mesh();
    CHECK((mesh.num_faces() == 12 * n * n && mesh.num_full_vertices() == block.x.rows()));
    CHECK(mesh.surface_positions(block.x).size() == 3 * s.full_vertices.size());
  }
}

TEST_CASE("positions turn faces outward, whatever the order of corners", "[property]") {
  scenes::Random random(5);
  Block block(3);
  for (Eigen::Index r = 0; r < block.T.rows(); ++r) {
    std::array<int, 4> t{block.T(r, 0), block.T(r, 1), block.T(r, 2), block.T(r, 3)};
    std::shuffle(t.begin(), t.end(), random);
    block.T.row(r) << t[0], t[1], t[2], t[3];
  }
  for (const double size : {1e-9, 1.0, 1e9}) {
    const TetrahedraSurface s = surface_of_tetrahedra(block.T, size * block.x);
    CHECK(is_closed(s));
    CHECK(std::fabs(enclosed(s, block.x) - 27) < 1e-12);
  }
}

TEST_CASE("a tetrahedron thinner than rounding is turned by its exact orientation", "[unit]") {
  MatrixXd x(4, 3);
  x << 0.1, 0.1, 0.1, 0.3, 0.3, 0.3, 0.7, 0.7, 0.7, 1, 0, 0;
  x(2, 2) = std::nextafter(0.7, 1);
  const auto first = surface_of_tetrahedra(Eigen::RowVector4i(0, 1, 2, 3), x),
             other = surface_of_tetrahedra(Eigen::RowVector4i(0, 2, 1, 3), x);
  const auto has = [](const TetrahedraSurface& s, int a, int b, int c) {
    return std::any_of(s.faces.begin(), s.faces.end(), [&](const std::array<int, 3>& f) {
      for (std::size_t i = 0; i < 3; ++i)
        if (f[i] == a && f[(i + 1) % 3] == b && f[(i + 2) % 3] == c) return true;
      return false;
    });
  };
  for (const auto& f : first.faces) CHECK(has(other, f[0], f[1], f[2]));
}

TEST_CASE("a tetrahedron of numbers far apart is turned by its exact orientation", "[unit]") {
  for (const double z : {1e-80, 1e-90, 1e-300, 0x1p-1074}) {
    MatrixXd x(4, 3);
    x << 0, 0, z, 1, 0, 0, 0, 1, 0, 0, 0, 1;
    CAPTURE(z);
    for (const Eigen::RowVector4i& corners : {Eigen::RowVector4i(0, 1, 2, 3), Eigen::RowVector4i(0, 2, 1, 3)})
      CHECK(std::fabs(enclosed(surface_of_tetrahedra(corners, x), x) - 1.0 / 6) < 1e-12);
  }
}

TEST_CASE("tetrahedra that are wrong are refused by their rows", "[unit]") {
  using Catch::Contains;
  MatrixXi T(3, 4);
  T << 0, 1, 2, 3, 0, 2, 1, 4, 0, 1, 2, 5;
  CHECK_THAT(refusal(T, 6), Contains("tetrahedron row 2: its face 0 1 2 is one of rows 0 and 1 already"));
  T.row(2) << 3, 2, 0, 1;
  CHECK_THAT(refusal(T, 6), Contains("tetrahedron row 2: is that of row 0 again"));
  T.row(2) << 3, 2, 6, 1;
  CHECK_THAT(refusal(T, 6), Contains("tetrahedron row 2: vertex 6 is out of range, there are 6"));
  T.row(2) << 3, 2, 3, 1;
  CHECK_THAT(refusal(T, 6), Contains("tetrahedron row 2: vertex 3 is repeated"));
  CHECK_THAT(refusal(T.leftCols(3), 6), Contains("3 columns, not 4"));
  CHECK_THAT(refusal(T, -1), Contains("-1 vertices"));
  MatrixXd x = MatrixXd::Random(6, 3);
  x(5, 0) = NAN;
  CHECK_THROWS_AS(surface_of_tetrahedra(T.topRows(1), x), std::invalid_argument);
  CHECK_THROWS_AS(surface_of_tetrahedra(T.topRows(1), MatrixXd::Random(6, 2)), std::invalid_argument);
  const TetrahedraSurface none = surface_of_tetrahedra(MatrixXi(0, 4), 2);
  CHECK((none.faces.empty() && none.surface_vertices == std::vector<int>{-1, -1}));
}
