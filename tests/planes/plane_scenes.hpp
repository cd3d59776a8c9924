// Random points and planes of every size, close to one another.
#pragma once

#include <onset/onset.hpp>

#include "tests/scenes/random.hpp"

namespace onset::tests {

struct PlaneScene {
  Eigen::MatrixXd x_t0, x_t1;
  CollisionRules rules;
  Options options;

  Mesh mesh() const { return Mesh(x_t0, Eigen::MatrixXi(0, 3), rules); }
};

// `plain`: sizes about 1, as simulators have them.
PlaneScene random_plane_scene(scenes::Random& random, bool plain);

// Positions up to 2^1020, the first of which have a height about the largest double.
PlaneScene plane_scene_at_the_largest_numbers(scenes::Random& random);

}  // namespace onset::tests
