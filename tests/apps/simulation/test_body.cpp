// The elastic bodies against finite differences, and the meshes that they come from.
#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "elastic/body.hpp"
#include "elastic/meshes/meshing.hpp"
#include "tests/catch.hpp"

namespace {

using namespace elastic;

Mat3 random_matrix(std::mt19937& random, double reach) {
  std::uniform_real_distribution<double> noise(-reach, reach);
  Mat3 m;
  for (int i = 0; i < 9; ++i) m(i % 3, i / 3) = noise(random);
  return m;
}

Vector flat(const std::vector<Vec3>& points) {
  Vector x(3 * Eigen::Index(points.size()));
  for (std::size_t v = 0; v < points.size(); ++v) x.segment<3>(3 * Eigen::Index(v)) = points[v];
  return x;
}

double volume_of(const TetMesh& mesh) {
  double sum = 0;
  for (const Tetrahedron& t : mesh.tetrahedra) {
    const Vec3 a = mesh.points[std::size_t(t[0])], b = mesh.points[std::size_t(t[1])] - a,
               c = mesh.points[std::size_t(t[2])] - a, d = mesh.points[std::size_t(t[3])] - a;
    const double volume = b.cross(c).dot(d) / 6;
    CHECK(volume > 0);
    sum += volume;
  }
  return sum;
}

}  // namespace

TEST_CASE("stress and stiffness of the material, inverted too", "[unit]") {
  const NeoHookean material({1000, 1e5, 0.4});
  std::mt19937 random(1);
  int inverted = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const Mat3 F = Mat3::Identity() * (trial % 2 ? 1 : -1) + random_matrix(random, 0.4);
    inverted += F.determinant() < 0;
    const Mat3 P = material.stress(F);
    const auto K = material.stiffness(F);
    const double h = 1e-6;
    for (int i = 0; i < 9; ++i) {
      Mat3 up = F, down = F;
      up(i % 3, i / 3) += h, down(i % 3, i / 3) -= h;
      CHECK(std::fabs((material.energy(up) - material.energy(down)) / (2 * h) - P(i % 3, i / 3)) <
            1e-6 * P.norm());
      const Mat3 change = (material.stress(up) - material.stress(down)) / (2 * h);
      CHECK((Eigen::Map<const Eigen::Matrix<double, 9, 1>>(change.data()) - K.col(i)).norm() <
            1e-6 * K.norm());
    }
  }
  CHECK(inverted >= 10);
}

TEST_CASE("at rest there is no stress, and small strains follow Hooke's law", "[unit]") {
  const double young = 1e5, poisson = 0.3;
  const NeoHookean material({1000, young, poisson});
  CHECK(material.stress(Mat3::Identity()).norm() < 1e-9 * young);
  const Eigen::AngleAxisd turn(1, Vec3(1, 2, 3).normalized());
  CHECK(material.stress(turn.toRotationMatrix()).norm() < 1e-9 * young);
  const double mu = young / (2 * (1 + poisson)),
               lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
  std::mt19937 random(2);
  const Mat3 any = random_matrix(random, 1), strain = 1e-6 * (any + any.transpose());
  const Mat3 expected = 2 * mu * strain + lambda * strain.trace() * Mat3::Identity();
  CHECK((material.stress(Mat3::Identity() + strain) - expected).norm() < 1e-4 * expected.norm());
}

TEST_CASE("a body's gradient and Hessian", "[unit]") {
  const TetMesh mesh = box({1, 1, 1}, {1, 1, 2});
  const Vector rest = flat(mesh.points);
  const std::vector<char> is_free(mesh.points.size(), 1);
  const Bodies bodies(rest, mesh.tetrahedra, is_free, {1000, 1e5, 0.4});
  double mass = 0;
  for (const double m : bodies.masses()) mass += m;
  CHECK(std::fabs(mass - 1000) < 1e-9);
  CHECK(std::fabs(bodies.least_volume(rest) - 1) < 1e-12);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> noise(-0.1, 0.1);
  Vector x = rest;
  for (double& c : x) c += noise(random);
  System system(is_free, Vector::Zero(x.size()));
  bodies.add_derivatives(x, system);
  const double h = 1e-6;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    Vector up = x, down = x;
    up[i] += h, down[i] -= h;
    const double slope = (bodies.energy(up) - bodies.energy(down)) / (2 * h);
    CHECK(std::fabs(slope + system.rhs()[i]) < 1e-6 * system.rhs().norm());
  }
  const Eigen::MatrixXd lower = system.lower();
  const Eigen::MatrixXd H = lower.selfadjointView<Eigen::Lower>();
  CHECK(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(H).eigenvalues()[0] > -1e-9 * H.norm());
  // Near rest nothing is projected away, and the assembled Hessian is the whole one.
  System near_rest(is_free, Vector::Zero(x.size()));
  bodies.add_derivatives(rest, near_rest);
  const Eigen::MatrixXd half = near_rest.lower();
  const Eigen::MatrixXd whole = half.selfadjointView<Eigen::Lower>();
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    Vector up = rest, down = rest;
    up[i] += h, down[i] -= h;
    System above(is_free, Vector::Zero(x.size())), below(is_free, Vector::Zero(x.size()));
    bodies.add_derivatives(up, above), bodies.add_derivatives(down, below);
    CHECK(((below.rhs() - above.rhs()) / (2 * h) - whole.col(i)).norm() < 1e-6 * whole.norm());
  }
}

TEST_CASE("meshes have the volumes of their shapes, and positive tetrahedra", "[unit]") {
  CHECK(std::fabs(volume_of(box({1, 2, 3}, {2, 3, 4})) - 6) < 1e-12);
  CHECK(box({1, 2, 3}, {2, 3, 4}).tetrahedra.size() == 6 * 24);
  const double pi = std::acos(-1.0);
  CHECK(std::fabs(volume_of(torus(0.3, 0.1, 1500)) / (2 * pi * pi * 0.3 * 0.01) - 1) < 0.1);
  CHECK(std::fabs(volume_of(ball(0.1, 600)) / (4 * pi / 3 * 1e-3) - 1) < 0.1);
  CHECK(std::fabs(volume_of(rounded_cube(0.1, 600)) / 6.48e-3 - 1) < 0.1);
  CHECK(std::fabs(volume_of(cone(0.5, 0.5, 200)) / (pi / 24) - 1) < 0.01);
  const TetMesh once = torus(0.3, 0.1, 600), again = torus(0.3, 0.1, 600);
  CHECK(once.tetrahedra == again.tetrahedra);
  CHECK(once.points == again.points);
}

TEST_CASE("an element without volume is refused by its number", "[unit]") {
  Vector x(12);
  x << 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0;
  CHECK_THROWS_WITH(Bodies(x, {{0, 1, 2, 3}}, std::vector<char>(4, 1), {}), "tetrahedron 0 has no volume");
}
