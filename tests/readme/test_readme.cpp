// Runs the C++ of the documents (documented.hpp and documented_fragments.hpp are cut out of them): the
// README's Newton loop on a cloth that falls onto a floor, fragments on a scene of their own.
#include <cmath>

#include "documented.hpp"
#include "documented_fragments.hpp"
#include "tests/catch.hpp"

namespace {

// Each vertex is pulled towards z = -1 and held above z = 0 by a logarithmic barrier, as in an interior-point
// contact method; the least energy is at the positive root of z (z + 1) = kappa. Below 0 the energy is NaN,
// which no comparison stops: only the limited step does. The floor, two triangles at z = 0, does not move.
struct FallingCloth {
  Eigen::Index floor = 4;  // rows of the floor's vertices
  double kappa = 1e-4;

  double operator()(const Eigen::MatrixXd& x, const onset::ClosePairs&) const {
    const auto z = x.bottomRows(x.rows() - floor).col(2).array();
    return (0.5 * (z + 1).square() - kappa * z.log()).sum();
  }
  Eigen::MatrixXd newton_direction(const Eigen::MatrixXd& x, const onset::ClosePairs&) const {
    const auto z = x.bottomRows(x.rows() - floor).col(2).array();
    Eigen::MatrixXd dx = Eigen::MatrixXd::Zero(x.rows(), 3);
    dx.bottomRows(x.rows() - floor).col(2) = -(z + 1 - kappa / z) / (1 + kappa / z.square());
    return dx;
  }
  double rest_height() const { return 0.5 * (std::sqrt(1 + 4 * kappa) - 1); }
};

// A floor of two triangles, and n x n vertices of cloth above it, wavy.
void make_scene(int n, Eigen::MatrixXd& x, Eigen::MatrixXi& F) {
  x.resize(4 + n * n, 3);
  F.resize(2 + 2 * (n - 1) * (n - 1), 3);
  x.topRows(4) << -2, -2, 0, 2, -2, 0, -2, 2, 0, 2, 2, 0;
  F.topRows(2) << 0, 1, 2, 1, 3, 2;
  for (int i = 0, f = 2; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double u = double(i) / (n - 1), v = double(j) / (n - 1);
      x.row(4 + i * n + j) << u, v, 0.5 + 0.1 * std::sin(7 * u) * std::cos(5 * v);
      if (i + 1 == n || j + 1 == n) continue;
      const int a = 4 + i * n + j, b = a + 1, c = a + n, d = c + 1;
      F.row(f++) << a, b, c;
      F.row(f++) << b, d, c;
    }
}

}  // namespace

TEST_CASE("the README's Newton loop converges to rest above the floor", "[unit]") {
  Eigen::MatrixXd x;
  Eigen::MatrixXi F;
  make_scene(9, x, F);
  const FallingCloth energy;
  // The first full step would go through the floor: without a limit there is nothing to show.
  REQUIRE((x + energy.newton_direction(x, {})).col(2).minCoeff() < -0.5);
  const Eigen::MatrixXd rest = newton(energy, onset::Mesh(x, F), x, 1e-3);
  for (Eigen::Index v = 4; v < rest.rows(); ++v) CHECK(std::abs(rest(v, 2) - energy.rest_height()) < 1e-9);
}

TEST_CASE("the README's rules are set, and hold", "[unit]") {
  README_1 block;
  REQUIRE(block.report.touching.size() == 1);
  const std::int64_t before = block.mesh.filter_counts().vertex_face.may_meet();
  block.run();
  const onset::Mesh& mesh = block.mesh;
  CHECK((mesh.num_bodies() == 5 && mesh.num_points() == 1 && mesh.num_full_vertices() == 20));
  CHECK(onset::check(mesh, block.x).touching.empty());
  CHECK(mesh.filter_counts().vertex_face.may_meet() < before);
}

TEST_CASE("every fragment of C++ in the documents runs", "[unit]") {
  int count = 0;
  for_all_fragments([&](auto block) {
    CHECK_NOTHROW(block.run());
    ++count;
  });
  CHECK(count >= 1);
}

TEST_CASE("every program in the documents ends well", "[unit]") {
  int count = 0;
  for_all_programs([&](int (*program)()) {
    CHECK(program() == 0);
    ++count;
  });
  CHECK(count >= 1);
}
