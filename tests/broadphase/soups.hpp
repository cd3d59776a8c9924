// Small meshes in motion that are hard on boxes, for comparison with brute force.
#pragma once

#include <string>
#include <vector>

#include "scene/mesh_data.hpp"
#include "scene/motion/motion.hpp"
#include "tests/scenes/random.hpp"

namespace onset::tests {

struct Soup {
  std::string name;
  MeshData mesh;
  std::vector<double> x_t0, x_t1;  // x y z of each vertex

  Motion motion() const {
    return make_motion(mesh.num_vertices, {x_t0.data(), mesh.num_vertices}, {x_t1.data(), mesh.num_vertices});
  }
};

// `faces` independent triangles and their edges, every coordinate from `coordinate(random)`, at both ends.
template <class F>
Soup triangles(const std::string& name, int faces, scenes::Random& random, F&& coordinate) {
  Soup soup;
  soup.name = name;
  soup.mesh.num_vertices = 3 * faces;
  for (int f = 0; f < faces; ++f) {
    soup.mesh.faces.push_back({3 * f, 3 * f + 1, 3 * f + 2});
    for (int k = 0; k < 3; ++k) soup.mesh.edges.push_back({3 * f + k, 3 * f + (k + 1) % 3});
  }
  for (int i = 0; i < 9 * faces; ++i) soup.x_t0.push_back(coordinate(random));
  for (int i = 0; i < 9 * faces; ++i) soup.x_t1.push_back(coordinate(random));
  return soup;
}

// Triangles of edge length about `size` over [-1, 1]^3, each vertex displaced by up to `speed`.
Soup scattered(const std::string& name, int faces, double size, double speed, scenes::Random& random);
// Random edges and faces over few vertices, so that many pairs share one.
Soup tangled(int vertices, int primitives, scenes::Random& random);

Soup scaled(Soup soup, const std::string& name, double factor);
Soup moved(Soup soup, const std::string& name, double x, double y, double z);

// One of each kind of trouble, of a few hundred primitives each.
std::vector<Soup> hard_soups();

}  // namespace onset::tests
