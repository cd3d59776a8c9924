// The scenes: elastic bodies, what they meet, and what is moved by hand.
#pragma once

#include <functional>
#include <onset/collision_rules.hpp>
#include <string>
#include <vector>

#include "elastic/meshes/meshing.hpp"

namespace elastic {

struct Scene {
  Vector x;     // at the start
  Vector rest;  // of all bodies
  std::vector<Tetrahedron> tetrahedra;
  std::vector<char> is_free;                              // not moved by hand
  std::vector<char> is_static;                            // never moved
  std::vector<int> bodies;                                // one id a vertex
  std::function<Vec3(int vertex, double time)> moved_to;  // vertices that are neither; empty: none
  std::vector<onset::Plane> planes;                       // with unit normals
  Vec3 gravity{0, 0, -9.81};
  double edge = 0;  // of the elements of bodies that are free, on average

  std::size_t vertices() const { return is_free.size(); }
};

struct SceneOptions {
  std::string name = "torus", mesh;
  int tetrahedra = 1500;  // of the bodies that are free, about
  unsigned seed = 1;      // of the turns at the start
};

// torus: one falls on a cone that stands still. bars: three side by side, held at both ends, which are
// turned. pile: eight bodies fall on each other and on the ground, a plane with four slopes around it. drop:
// a body out of a file, `mesh`, falls on the ground. Throws std::invalid_argument for other names,
// app::InputError for the file.
Scene make_scene(const SceneOptions& options);

}  // namespace elastic
