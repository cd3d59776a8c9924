// The surface of a tetrahedral mesh, as a mesh of its own.
#pragma once

#include <array>
#include <cstddef>
#include <onset/collision_rules.hpp>
#include <onset/export.hpp>
#include <onset/mesh.hpp>
#include <onset/views.hpp>
#include <vector>

namespace onset {

// Faces and edges by ids of the surface, which has only the vertices that they use.
struct TetrahedraSurface {
  // Counter-clockwise as seen from outside, by tetrahedron and then by the corner that a face lies opposite
  // to.
  std::vector<std::array<int, 3>> faces;
  // Each once, in the order of igl::edges.
  std::vector<std::array<int, 2>> edges;
  // For each vertex of the surface its id in the tetrahedral mesh, ascending: what Mesh::set_full_vertices
  // takes. And for each vertex of the tetrahedral mesh its id in the surface; -1: it is inside, or unused.
  std::vector<int> full_vertices, surface_vertices;

  // Makes the mesh of the surface, which knows its vertices in the tetrahedral one. Throws as Mesh for rules
  // that are wrong.
  Mesh mesh(const CollisionRules& rules = {}) const {
    Eigen::MatrixXi F(faces.size(), 3);
    for (std::size_t f = 0; f < faces.size(); ++f) F.row(f) << faces[f][0], faces[f][1], faces[f][2];
    Mesh surface(std::ptrdiff_t(full_vertices.size()), edge_matrix(edges), F, rules);
    surface.set_full_vertices(full_vertices, std::ptrdiff_t(surface_vertices.size()));
    return surface;
  }
};

// Finds the faces that belong to one tetrahedron only, their edges, and their vertices.
//
// Guarantee: all faces of the surface, and no others; each is turned outward from its own tetrahedron, whose
// orientation is decided exactly by the positions, where they are given. #T log #T.
//
// tetrahedra: #T x 4 ids of vertices.
// x: #V x 3, model length: positions of all vertices, with which a tetrahedron may have its corners in either
// order. One without volume counts as positive. Without x, (b - a) x (c - a) . (d - a) > 0 is taken for
// granted for a row a b c d.
// vertices: #V.
// Throws std::invalid_argument naming the row for a wrong number of columns, an id out of [0, #V), a repeated
// vertex, a tetrahedron that is there twice, and a face of three tetrahedra or more; and for x of other than
// 3 columns, or not finite.
// Safe to call concurrently.
//
// Example:
//   const Eigen::MatrixXi T = Eigen::RowVector4i(0, 1, 2, 9);
//   const onset::Mesh surface = onset::surface_of_tetrahedra(T, x).mesh();
//   const std::vector<double> p = surface.surface_positions(x);
//   const onset::ClosePairs close =
//       onset::close_pairs(surface, onset::Positions(p.data(), surface.num_vertices()), 1e-3);
ONSET_API TetrahedraSurface surface_of_tetrahedra(const Indices& tetrahedra, const Positions& x);
ONSET_API TetrahedraSurface surface_of_tetrahedra(const Indices& tetrahedra, std::ptrdiff_t vertices);

}  // namespace onset
