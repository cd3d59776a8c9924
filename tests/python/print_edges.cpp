// Reads triangles (three vertex ids each) on standard input, prints onset::edges of them, one edge a line.
#include <cstdio>
#include <iostream>
#include <onset/onset.hpp>
#include <vector>

int main() {
  std::ios::sync_with_stdio(false);
  std::vector<int> ids;
  for (int v; std::cin >> v;) ids.push_back(v);
  if (ids.size() % 3 != 0 || !std::cin.eof()) {
    std::fprintf(stderr, "not a list of triangles\n");
    return 1;
  }
  using Rows = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;
  const Eigen::MatrixXi E = onset::edges(Eigen::Map<const Rows>(ids.data(), Eigen::Index(ids.size() / 3), 3));
  for (Eigen::Index i = 0; i < E.rows(); ++i) std::printf("%d %d\n", E(i, 0), E(i, 1));
}
