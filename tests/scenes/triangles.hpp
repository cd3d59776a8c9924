// Triangles that share no vertex, and random places.
#pragma once

#include <Eigen/Core>

#include "tests/scenes/random.hpp"

namespace onset::scenes {

inline Eigen::RowVector3d any(Random& random, double size) {
  return {uniform(random, -size, size), uniform(random, -size, size), uniform(random, -size, size)};
}

inline Eigen::MatrixXi triangles(int count) {
  Eigen::MatrixXi faces(count, 3);
  for (int i = 0; i < count; ++i) faces.row(i) << 3 * i, 3 * i + 1, 3 * i + 2;
  return faces;
}

}  // namespace onset::scenes
