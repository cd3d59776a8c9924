// A library that uses onset, and that a host loads and unloads.
#include <onset/onset.hpp>

// The step of a sheet of 2 * 80 * 80 triangles that falls by 2 onto another, 1 below; in `threads` threads.
extern "C" __declspec(dllexport) double step_of_sheets(int threads) {
  const int n = 81;
  Eigen::MatrixXd x0(2 * n * n, 3);
  Eigen::MatrixXi F(4 * (n - 1) * (n - 1), 3);
  int f = 0;
  for (int sheet = 0; sheet < 2; ++sheet)
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const int v = (sheet * n + i) * n + j;
        x0.row(v) << i + 0.25 * sheet, j + 0.375 * sheet, sheet;
        if (i + 1 == n || j + 1 == n) continue;
        F.row(f++) << v, v + n, v + n + 1;
        F.row(f++) << v, v + n + 1, v + 1;
      }
  Eigen::MatrixXd x1 = x0;
  x1.bottomRows(n * n).col(2).array() -= 2;
  onset::Options options;
  options.threads = threads;
  return onset::compute_collision_free_stepsize(onset::Mesh(x0, F), x0, x1, options).step;
}
