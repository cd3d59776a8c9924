// The barrier of nearly parallel edges against finite differences.
#include <cmath>
#include <random>

#include "simulation/contact.hpp"
#include "tests/catch.hpp"

namespace {

using namespace simulation;

onset::ClosePairs near(const Vector& x) {
  Eigen::MatrixXi E(2, 2);
  E << 0, 1, 2, 3;
  return onset::close_pairs(onset::Mesh(4, E, Eigen::MatrixXi(0, 3)), x, 0.2);
}

double energy(const Barrier& barrier, const Vector& x) { return barrier.energy(near(x), x); }

// Two edges that cross at an angle of about 0.02, shifted along each other: with `shift` 0 inside, by 1.5 end
// near end.
Vector edges(double shift, double angle, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> noise(-1e-3, 1e-3);
  Vector x(12);
  x << -1, 0, 0, 1, 0, 0, shift - 1, -angle, 0.1, shift + 1, angle, 0.1;
  for (double& c : x) c += noise(random);
  return x;
}

}  // namespace

TEST_CASE("gradient and Hessian of the mollified barrier", "[unit]") {
  Vector rest(12);
  rest << 0, 0, 0, 2, 0, 0, 0, 0, 1, 0, 2, 1;  // e = 1e-3 * 16
  const Barrier barrier(3.0, 0.2, rest);
  int inside = 0, at_ends = 0;
  for (unsigned seed = 0; seed < 20; ++seed)
    for (const double shift : {0.0, 1.5, 2.01}) {
      const Vector x = edges(shift, 0.02, seed);
      const onset::ClosePairs close = near(x);
      REQUIRE(close.size() == 1);
      const onset::ClosePair& pair = close.pairs[0];
      REQUIRE(barrier.is_mollified(pair, x));
      bool is_inside = true;
      for (const double w : pair.weights) is_inside = is_inside && w != 0;
      (is_inside ? inside : at_ends) += 1;
      const Barrier::Mollified m = barrier.mollified(pair, x);
      CHECK(m.energy == energy(barrier, x));
      CHECK(m.energy > 0);
      const double h = 1e-6;
      for (int i = 0; i < 12; ++i) {
        Vector up = x, down = x;
        const int dof = 3 * pair.vertices[std::size_t(i / 3)] + i % 3;
        up[dof] += h, down[dof] -= h;
        const double slope = (energy(barrier, up) - energy(barrier, down)) / (2 * h);
        CHECK(std::fabs(slope - m.gradient[i]) < 1e-6 * m.gradient.norm());
        const auto above = barrier.mollified(near(up).pairs[0], up),
                   below = barrier.mollified(near(down).pairs[0], down);
        const Eigen::Matrix<double, 12, 1> column = (above.gradient - below.gradient) / (2 * h);
        CHECK((column - m.hessian.col(i)).norm() < 1e-4 * m.hessian.norm());
      }
    }
  CHECK(inside >= 10);
  CHECK(at_ends >= 10);
}

TEST_CASE("the mollifier ends where edges are not parallel, and takes parallel ones out", "[unit]") {
  Vector rest(12);
  rest << 0, 0, 0, 2, 0, 0, 0, 0, 1, 0, 2, 1;
  const Barrier with(3.0, 0.2, rest), without(3.0, 0.2);
  const Vector crossing = edges(0, 0.5, 1);
  CHECK_FALSE(with.is_mollified(near(crossing).pairs[0], crossing));
  CHECK(energy(with, crossing) == energy(without, crossing));
  Vector parallel(12);
  parallel << -1, 0, 0, 1, 0, 0, -0.9, 0, 0.1, 1.1, 0, 0.1;
  CHECK(energy(with, parallel) == 0);
  CHECK(energy(without, parallel) > 0);
}

TEST_CASE("what is added to the system has no negative curvature", "[unit]") {
  Vector rest(12);
  rest << 0, 0, 0, 2, 0, 0, 0, 0, 1, 0, 2, 1;
  const Barrier barrier(3.0, 0.2, rest);
  const Vector x = edges(0, 0.02, 3);
  const onset::ClosePairs close = near(x);
  const Barrier::Mollified m = barrier.mollified(close.pairs[0], x);
  using Solver = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>;
  CHECK(Solver(m.hessian).eigenvalues()[0] < -1e-3 * m.hessian.norm());
  System system(std::vector<char>(4, 1), Vector::Zero(12));
  barrier.add_derivatives(close, {}, x, system);
  const Eigen::MatrixXd lower = system.lower();
  const Eigen::MatrixXd H = lower.selfadjointView<Eigen::Lower>();
  CHECK(Solver(H).eigenvalues()[0] > -1e-9 * H.norm());
  CHECK((system.rhs() + m.gradient).norm() < 1e-12 * m.gradient.norm());
}
