// Tetrahedral meshes: of implicit functions by CGAL's Mesh_3, of boxes and cones by hand.
#pragma once

#include <functional>
#include <vector>

#include "elastic/body.hpp"

namespace elastic {

// Tetrahedra with (b - a) x (c - a) . (d - a) > 0.
struct TetMesh {
  std::vector<Vec3> points;
  std::vector<Tetrahedron> tetrahedra;
};

// {p : f(p) < 0}, which contains its centre, the origin, or lies about it, within the ball of `radius`;
// `count` tetrahedra of a body of that volume, about. The same input gives the same mesh.
TetMesh mesh_implicit(const std::function<double(const Vec3&)>& f, double radius, double volume, int count);

TetMesh torus(double large, double small, int count);
TetMesh ball(double radius, int count);
TetMesh rounded_cube(double half, int count);  // |x|^4 + |y|^4 + |z|^4 < half^4

// Centred, of x by y by z cells, of six tetrahedra each.
TetMesh box(const Vec3& size, const std::array<int, 3>& cells);
// Its base in the plane z = 0, about the origin, its tip at `height`.
TetMesh cone(double radius, double height, int sides);

}  // namespace elastic
