// Meshes that intersect, touch and overlap themselves in every way, at rest.
#pragma once

#include <Eigen/Core>
#include <onset/mesh.hpp>
#include <string>

#include "tests/scenes/random.hpp"

namespace onset::tests {

struct Crowd {
  std::string name;
  Mesh mesh;
  Eigen::MatrixXd x;
};

// `count` triangles, half as many wires and points, vertices on integers in [-size, size]^3: most of what
// touches does so exactly. Faces may have no area, edges no length, and vertices share places.
Crowd grid_crowd(int count, int size, scenes::Random& random);

// Of all kinds: grids, soups without structure, sheets in one plane, folded strips.
Crowd some_crowd(int round, scenes::Random& random);

// Two sheets, one above the other.
Crowd apart_crowd();

}  // namespace onset::tests
