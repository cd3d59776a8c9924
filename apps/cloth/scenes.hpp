// The scenes: cloth, what it meets, and what is moved by hand.
#pragma once

#include <array>
#include <functional>
#include <onset/collision_rules.hpp>
#include <optional>
#include <string>
#include <vector>

#include "simulation/system.hpp"

namespace cloth {

using namespace simulation;

// Vertices from `first` on that turn about `centre` as one rigid body; rate: a rotation vector, rad/s.
struct Turning {
  int first;
  Vec3 rate, centre;
};

struct Scene {
  Vector x;                               // at the start
  Vector rest;                            // of the cloth, flat
  std::vector<std::array<int, 3>> faces;  // the cloth's first
  std::size_t cloth_faces = 0;
  std::vector<onset::Plane> planes;                       // with unit normals
  std::vector<char> is_free;                              // not moved by hand
  std::function<Vec3(int vertex, double time)> moved_to;  // vertices that are not free, or do not move
  std::optional<Turning> turning;                         // these are not free either
  Vec3 gravity{0, 0, -9.81};
  double edge = 0;  // of the cloth, about
};

// sphere: a cloth falls on a sphere that turns. twist: a strip held at both ends, which are turned. pile:
// sheets fall on each other, on a ball and on the floor. ground: the same, where the floor is a plane
// (onset::CollisionRules::planes). `triangles`: of the cloth, about. Throws
// std::invalid_argument for other names.
Scene make_scene(const std::string& name, int triangles, unsigned seed);

}  // namespace cloth
