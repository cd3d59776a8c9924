// The public headers in a second translation unit: everything in them must be inline.
#include <onset/onset.hpp>

Eigen::Index edges_of_a_tetrahedron() {
  Eigen::MatrixXi F(4, 3);
  F << 0, 1, 2, 0, 1, 3, 0, 2, 3, 1, 2, 3;
  return onset::edges(F).rows();
}
