// What a broad phase of another library is given, and what it offers to be measured by.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <onset/onset.hpp>
#include <string>
#include <vector>

#include "files/mesh/mesh_file.hpp"

namespace app {

// Swept boxes of a scene's vertices, edges and faces, exact in double: the input of every peer.
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

struct Peer {
  std::string name;
  // From positions to pairs that share no vertex: swept boxes, tree, pairs; nothing reused but memory.
  std::function<onset::PairCounts(const Points& x_t0, const Points& x_t1)> find;
};

// Adjacency by the vertex ids of the mesh, the same for every peer.
struct Neighbours {
  const onset::Mesh& mesh;
  bool share_vertex(int edge, int other_edge) const {
    const auto a = mesh.edge(edge), b = mesh.edge(other_edge);
    return a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1];
  }
  bool is_corner(int vertex, int face) const {
    const auto f = mesh.face(face);
    return f[0] == vertex || f[1] == vertex || f[2] == vertex;
  }
};

// FCL's dynamic AABB tree, one thread; its objects are kept, pairs are stored in reused memory. The tree is
// built anew, or kept and brought up to date by FCL's own update().
enum class Tree { built, updated };
Peer fcl_peer(const onset::Mesh& mesh, Tree tree);

// Embree's rtcCollide over user geometry, one thread; pairs counted, not stored, which is less work.
Peer embree_peer(const onset::Mesh& mesh);

}  // namespace app
