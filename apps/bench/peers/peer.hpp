// What a broad phase of another library offers to be measured by.
#pragma once

#include <functional>
#include <onset/onset.hpp>
#include <string>

#include "bench/peers/boxes.hpp"

namespace app {

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
