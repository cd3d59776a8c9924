// Positions in every layout that callers have give the same answer.
#include "tests/catch.hpp"
#include "tests/src/support/scene_set.hpp"

using namespace onset;
using namespace onset::tests;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

namespace {

struct Fixture {
  NamedScene named = some_scenes()[1];
  Mesh mesh = named.mesh();
  const Eigen::MatrixXd &x_t0 = named.scene.x_t0, &x_t1 = named.scene.x_t1;
  ActiveSet reference = construct_active_set(mesh, x_t0, x_t1);

  void check(const Positions& a, const Positions& b) const {
    CHECK(same_bytes(reference, construct_active_set(mesh, a, b)));
    CHECK(compute_collision_free_stepsize(mesh, a, b).step ==
          compute_collision_free_stepsize(mesh, x_t0, x_t1).step);
  }
};

}  // namespace

TEST_CASE("row-major positions", "[unit]") {
  const Fixture f;
  REQUIRE(f.reference.size() > 0);
  const RowMajor a = f.x_t0, b = f.x_t1;
  f.check(a, b);
  f.check(a, f.x_t1);
}

TEST_CASE("flat degrees of freedom, as a column, a row, a map and a pointer", "[unit]") {
  const Fixture f;
  const RowMajor a = f.x_t0, b = f.x_t1;
  const Eigen::VectorXd flat_a = Eigen::Map<const Eigen::VectorXd>(a.data(), a.size());
  const Eigen::VectorXd flat_b = Eigen::Map<const Eigen::VectorXd>(b.data(), b.size());
  f.check(flat_a, flat_b);
  const Eigen::RowVectorXd row_a = flat_a.transpose(), row_b = flat_b.transpose();
  f.check(row_a, row_b);
  f.check(Eigen::Map<const RowMajor>(a.data(), a.rows(), 3),
          Eigen::Map<const RowMajor>(b.data(), b.rows(), 3));
  f.check(Positions(a.data(), a.rows()), Positions(b.data(), b.rows()));
}

TEST_CASE("expressions, blocks and strides", "[unit]") {
  const Fixture f;
  const Eigen::MatrixXd dx = f.x_t1 - f.x_t0, exact_t1 = f.x_t0 + dx;
  CHECK(same_bytes(construct_active_set(f.mesh, f.x_t0, exact_t1),
                   construct_active_set(f.mesh, f.x_t0, f.x_t0 + dx)));
  f.check(1 * f.x_t0, 0.5 * (2 * f.x_t1));

  const Eigen::Index n = f.x_t0.rows();
  Eigen::MatrixXd larger = Eigen::MatrixXd::Constant(n + 7, 11, NAN);
  larger.block(3, 2, n, 3) = f.x_t0, larger.block(3, 6, n, 3) = f.x_t1;
  f.check(larger.block(3, 2, n, 3), larger.block(3, 6, n, 3));

  std::vector<double> padded(std::size_t(n) * 8, NAN);  // x y z _ at t = 0, then at t = 1
  for (Eigen::Index v = 0; v < n; ++v)
    for (int a = 0; a < 3; ++a)
      padded[std::size_t(8 * v + a)] = f.x_t0(v, a), padded[std::size_t(8 * v + 4 + a)] = f.x_t1(v, a);
  using Strided = Eigen::Map<const RowMajor, 0, Eigen::OuterStride<>>;
  f.check(Strided(padded.data(), n, 3, Eigen::OuterStride<>(8)),
          Strided(padded.data() + 4, n, 3, Eigen::OuterStride<>(8)));

  Eigen::VectorXd spread = Eigen::VectorXd::Constant(6 * n, NAN);
  const RowMajor a = f.x_t0;
  for (Eigen::Index i = 0; i < 3 * n; ++i) spread(2 * i) = a.data()[i];
  f.check(Eigen::Map<const Eigen::VectorXd, 0, Eigen::InnerStride<2>>(spread.data(), 3 * n), f.x_t1);
  f.check(f.x_t0.colwise().reverse().colwise().reverse(), f.x_t1);
}

TEST_CASE("float positions answer as the same numbers in double", "[unit]") {
  const Fixture f;
  const Eigen::MatrixXf a = f.x_t0.cast<float>(), b = f.x_t1.cast<float>();
  const Eigen::MatrixXd da = a.cast<double>(), db = b.cast<double>();
  CHECK(same_bytes(construct_active_set(f.mesh, da, db), construct_active_set(f.mesh, a, b)));
}
