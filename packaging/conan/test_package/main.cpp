// A triangle falls by 2 onto another one, 1 below: it can go half of the way.
#include <cstdio>
#include <onset/onset.hpp>

int main() {
  Eigen::MatrixXd x0(6, 3);
  x0 << 0, 0, 0, 4, 0, 0, 0, 4, 0, 0.5, 0.5, 1, 3, 0.5, 1, 0.5, 3, 1;
  Eigen::MatrixXd x1 = x0;
  x1.bottomRows(3).col(2).array() -= 2;
  Eigen::MatrixXi F(2, 3);
  F << 0, 1, 2, 3, 4, 5;
  const double step = onset::compute_collision_free_stepsize(onset::Mesh(x0, F), x0, x1).step;
  std::printf("step %.17g\n", step);
  return step > 0.499 && step <= 0.5 ? 0 : 1;
}
