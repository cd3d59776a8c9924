// Swept boxes of a scene's vertices, edges and faces, exact in double: the input that every broad phase is
// given.
#pragma once

#include <Eigen/Core>
#include <onset/mesh.hpp>
#include <vector>

#include "files/mesh/mesh_file.hpp"

namespace app {

struct Box {
  Eigen::Vector3d lo, hi;
};

struct Boxes {
  std::vector<Box> vertices, edges, faces;
};

inline Box hull(const Box& a, const Box& b) { return {a.lo.cwiseMin(b.lo), a.hi.cwiseMax(b.hi)}; }

// Into memory that is reused.
inline void make_boxes(const onset::Mesh& mesh, const Points& x_t0, const Points& x_t1, Boxes& boxes) {
  boxes.vertices.resize(std::size_t(mesh.num_vertices()));
  boxes.edges.resize(std::size_t(mesh.num_edges()));
  boxes.faces.resize(std::size_t(mesh.num_faces()));
  for (std::size_t v = 0; v < boxes.vertices.size(); ++v) {
    const Eigen::Vector3d a = x_t0.row(Eigen::Index(v)), b = x_t1.row(Eigen::Index(v));
    boxes.vertices[v] = {a.cwiseMin(b), a.cwiseMax(b)};
  }
  const auto of = [&](int v) -> const Box& { return boxes.vertices[std::size_t(v)]; };
  for (std::size_t e = 0; e < boxes.edges.size(); ++e) {
    const auto v = mesh.edge(std::ptrdiff_t(e));
    boxes.edges[e] = hull(of(v[0]), of(v[1]));
  }
  for (std::size_t f = 0; f < boxes.faces.size(); ++f) {
    const auto v = mesh.face(std::ptrdiff_t(f));
    boxes.faces[f] = hull(hull(of(v[0]), of(v[1])), of(v[2]));
  }
}

}  // namespace app
