// Seeded triangle soups, slow and fast, with or without a separation and at two tolerances.
#pragma once

#include <onset/onset.hpp>

#include "tests/scenes/meshes.hpp"

namespace onset::tests {

struct Soup {
  scenes::Scene scene;
  Mesh mesh;
  Options options;
};

inline Soup soup(unsigned seed, int faces) {
  scenes::Random random(seed);
  const bool fast = seed % 7 == 5;  // triangles pass one another
  const double size = fast ? 0.05 : 0.15, speed = fast ? 0.6 : seed % 4 == 0 ? 0.02 : 0.2;
  const scenes::Scene scene = scenes::triangle_soup(faces, size, speed, random);
  Options options;
  options.min_separation = seed % 3 == 0 ? 1e-3 : 0;
  options.relative_tolerance = seed % 2 == 0 ? 1e-3 : 1e-7;
  return {scene, Mesh(scene.x_t0, scene.faces), options};
}

}  // namespace onset::tests
