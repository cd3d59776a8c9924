// Surfaces that are a sparse map of degrees of freedom: against matrices and exact sums.
#include <onset/compat/collision_mesh.hpp>
#include <onset/vertex_map.hpp>

#include "tests/catch.hpp"
#include "tests/oracle/arithmetic/rational.hpp"
#include "tests/oracle/stored.hpp"
#include "tests/scenes/random.hpp"
#include "tests/src/support/scene_set.hpp"

using namespace onset;
using namespace onset::tests;
using Eigen::MatrixXd;
using Eigen::SparseMatrix;
using Eigen::VectorXd;
using oracle::Rational;

namespace {

// One to four weights a row.
SparseMatrix<double> random_map(scenes::Random& random, int rows, int columns) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int r = 0; r < rows; ++r) {
    const int first = scenes::integer(random, 0, columns - 4);
    for (int c = 0; c <= scenes::integer(random, 0, 3); ++c)
      entries.emplace_back(r, first + c, scenes::uniform(random, -1, 1));
  }
  SparseMatrix<double> m(rows, columns);
  m.setFromTriplets(entries.begin(), entries.end());
  return m;
}

VectorXd random_vector(scenes::Random& random, Eigen::Index size) {
  VectorXd v(size);
  for (double& x : v) x = scenes::uniform(random, -1, 1) * scenes::power_of_ten(random, -3, 3);
  return v;
}

VectorXd vector(const std::vector<double>& v) {
  return Eigen::Map<const VectorXd>(v.data(), Eigen::Index(v.size()));
}

MatrixXd dense(const Constraints& c, std::ptrdiff_t columns) {
  MatrixXd A = MatrixXd::Zero(c.rows(), columns);
  for (std::size_t k = 0; k < c.value.size(); ++k) A(c.row[k], c.dof[k]) += c.value[k];
  return A;
}

}  // namespace

TEST_CASE("positions are the sums of weighted dofs, within their bound", "[oracle]") {
  scenes::Random random(2);
  for (int i = 0; i < 40; ++i) {
    const int n = scenes::integer(random, 1, 9), nodes = scenes::integer(random, 4, 8);
    const bool by_vertex = scenes::coin(random);
    const SparseMatrix<double> weights =
        by_vertex ? random_map(random, n, nodes) : random_map(random, 3 * n, 3 * nodes + 1);
    const VertexMap map(n, weights);
    const std::ptrdiff_t dofs = by_vertex ? 3 * nodes : 3 * nodes + 1;
    REQUIRE((map.num_vertices() == n && map.num_dofs() == dofs));
    const MatrixXd M = map.matrix();
    for (int r = 0; r < 3 * n; ++r)
      for (int c = 0; c < dofs; ++c) {
        const MatrixXd all = weights;
        CHECK(M(r, c) == (!by_vertex ? all(r, c) : r % 3 == c % 3 ? all(r / 3, c / 3) : 0));
      }
    const VectorXd q = random_vector(random, dofs), x = vector(map.positions(q));
    for (int r = 0; r < 3 * n; ++r) {
      Rational exact = 0, size = 0;
      for (int c = 0; c < dofs; ++c)
        exact += Rational(M(r, c)) * Rational(q[c]), size += Rational(std::fabs(M(r, c) * q[c]));
      CHECK(abs(exact - Rational(x[r])) <= size * Rational(4.1 * 0x1p-53));
    }
    if (by_vertex) {
      const MatrixXd rows =
          Eigen::Map<const Eigen::Matrix<double, -1, 3, Eigen::RowMajor>>(q.data(), nodes, 3);
      CHECK(vector(map.positions(rows)) == x);
    }
  }
}

TEST_CASE("positions evaluated from stored dofs are as near as said to the motion between their ends",
          "[oracle]") {
  scenes::Random random(4);
  for (int i = 0; i < 60; ++i) {
    const int nodes = 6;
    const VertexMap map(2, random_map(random, 2, nodes));
    const VectorXd q0 = random_vector(random, 3 * nodes),
                   q1 = scenes::coin(random) ? random_vector(random, 3 * nodes)
                                             : VectorXd(q0 + 1e-9 * random_vector(random, 3 * nodes));
    const VectorXd x0 = vector(map.positions(q0)), x1 = vector(map.positions(q1));
    const double bound = map.rounding(q0, q1), s = scenes::unit(random);
    CHECK((bound > 0 && bound < 1e-10));
    for (const oracle::Rounding how : oracle::kRoundings) {
      VectorXd q(q0.size());
      for (Eigen::Index k = 0; k < q.size(); ++k) q[k] = oracle::stored(how, q0[k], q1[k], s);
      const VectorXd x = vector(map.positions(q));
      for (const int v : {0, 3}) {  // two points move by half of it each at most
        Rational square = 0;
        for (int a = 0; a < 3; ++a) {
          const Rational d = Rational(x[v + a]) - Rational(x0[v + a]) -
                             Rational(s) * (Rational(x1[v + a]) - Rational(x0[v + a]));
          square += d * d;
        }
        CHECK(4 * square <= Rational(bound) * Rational(bound));
      }
    }
  }
}

TEST_CASE("constraints, gradients and Hessians go to the dofs", "[unit]") {
  scenes::Random random(8);
  std::size_t rows = 0;
  for (const NamedScene& named : some_scenes()) {
    const Mesh mesh = named.mesh();
    const int n = int(mesh.num_vertices()), nodes = n + 5;
    if (n > 200) continue;
    const VertexMap map(n, random_map(random, n, nodes));
    const ActiveSet set = construct_active_set(mesh, named.scene.x_t0, named.scene.x_t1);
    const Constraints surface = assemble_constraints(set, 0.25), c = assemble_constraints(set, 0.25, map);
    CAPTURE(named.name, set.size());
    rows += set.size();
    const MatrixXd M = map.matrix(), expected = dense(surface, 3 * n) * M;
    CHECK((dense(c, map.num_dofs()) - expected).cwiseAbs().sum() <= 1e-13 * (1 + expected.cwiseAbs().sum()));
    CHECK(c.bound == surface.bound);
    for (std::size_t k = 1; k < c.value.size(); ++k)
      CHECK((c.row[k] > c.row[k - 1] || (c.row[k] == c.row[k - 1] && c.dof[k] > c.dof[k - 1])));
    const VectorXd g = random_vector(random, 3 * n), h = random_vector(random, 3 * n);
    CHECK((map.to_dofs(g) - M.transpose() * g).norm() <= 1e-12 * g.norm());
    SparseMatrix<double> H(3 * n, 3 * n);
    for (int k = 0; k < 3 * n; ++k) H.insert(k, (7 * k) % (3 * n)) = h[k];
    CHECK((MatrixXd(map.to_dofs(H)) - M.transpose() * MatrixXd(H) * M).norm() <= 1e-12 * h.norm());
  }
  CHECK(rows > 50);
}

TEST_CASE("the adapter's displacement map is the same map", "[unit]") {
  scenes::Random random(6);
  const NamedScene named = some_scenes()[3];
  const MatrixXd& x = named.scene.x_t0;
  const int n = int(x.rows()), nodes = n + 5;
  for (const bool by_vertex : {true, false}) {
    const SparseMatrix<double> weights =
        by_vertex ? random_map(random, n, nodes) : random_map(random, 3 * n, 3 * nodes);
    const ipc::CollisionMesh mesh(x, edges(named.scene.faces), named.scene.faces, weights);
    const MatrixXd u = MatrixXd::Random(nodes, 3);
    const Eigen::Matrix<double, -1, -1, Eigen::RowMajor> rows = u;
    const VectorXd flat = Eigen::Map<const VectorXd>(rows.data(), rows.size());
    const MatrixXd surface = mesh.map_displacements(u);
    const Eigen::Matrix<double, -1, -1, Eigen::RowMajor> there = surface;
    CHECK(Eigen::Map<const VectorXd>(there.data(), there.size()) ==
          vector(VertexMap(n, weights).positions(flat)));
    if (by_vertex) CHECK(surface == MatrixXd(weights * u));
    CHECK(mesh.full_num_vertices() == std::size_t(nodes));
  }
}

TEST_CASE("maps of another shape, and values of another number, are refused", "[unit]") {
  scenes::Random random(9);
  SparseMatrix<double> weights = random_map(random, 4, 5);
  CHECK_THROWS_WITH(VertexMap(3, weights),
                    Catch::Contains("4 x 5: for 3 vertices it is 3 x #nodes or 9 x #dof"));
  CHECK_THROWS_AS(VertexMap(-1, weights), std::invalid_argument);
  const VertexMap map(4, weights);
  CHECK_THROWS_WITH(map.positions(MatrixXd::Zero(3, 5)),
                    "got 3 x 5 values; a vector, or 3 columns, are expected");
  CHECK(map.positions(MatrixXd::Zero(5, 3)).size() == 12);
  CHECK(map.dimension() == 3);
  ActiveSet in_plane;
  in_plane.dimension = 2;
  CHECK_THROWS_WITH(assemble_constraints(in_plane, 0, map), "the map has 3 dimensions, the contacts 2");
  Constraints short_one;
  short_one.row = {0}, short_one.value = {1, 2}, short_one.dof = {0, 1};
  CHECK_THROWS_WITH(map.constraints(short_one), "the constraints have 1 rows, 2 dofs and 2 values");
  CHECK_THROWS_WITH(map.positions(VectorXd(14)), Catch::Contains("got 14 values; the map has 15 dofs"));
  CHECK_THROWS_AS(map.rounding(VectorXd::Zero(15), VectorXd::Zero(3)), std::invalid_argument);
  CHECK_THROWS_AS(map.to_dofs(VectorXd(VectorXd::Zero(11))), std::invalid_argument);
  CHECK_THROWS_AS(map.to_dofs(SparseMatrix<double>(12, 11)), std::invalid_argument);
  Constraints c;
  c.row = {0}, c.dof = {12}, c.value = {1}, c.bound = {0};
  CHECK_THROWS_WITH(map.constraints(c), Catch::Contains("entry 0 of the constraints is of dof 12"));
  weights.coeffRef(2, 3) = NAN;
  CHECK_THROWS_WITH(VertexMap(4, weights), Catch::Contains("row 2, column 3 is not finite"));
  VectorXd q = VectorXd::Zero(15);
  q[1] = INFINITY;
  CHECK((std::isinf(map.rounding(q, q)) || map.matrix().col(1).nonZeros() == 0));
  CHECK(VertexMap().positions(VectorXd(0)).empty());
}
