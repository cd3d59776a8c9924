// Vertices that go together: copies that count as one, and those of a rigid body.
#pragma once

#include <cstddef>
#include <vector>

#include "base/stop.hpp"
#include "scene/mesh_data.hpp"
#include "scene/motion/motion.hpp"

namespace onset {

// Every vertex is in one group, most of them alone. Groups are numbered by their first vertex.
class VertexGroups {
 public:
  // x_t0: the positions at the start, in any order of axes. Not all are joined where it is stopped.
  VertexGroups(const MeshData& mesh, const Motion& motion, const Positions& x_t0, const Stop& stop);
  // The same of positions: x_t0 is finite.
  VertexGroups(const MeshData& mesh, const Positions& x_t0, const Positions& x_t1, const Stop& stop);

  std::size_t size() const { return start_.size() - 1; }
  int of(int vertex) const { return group_[std::size_t(vertex)]; }
  // The vertices of a group, ascending.
  const int* begin(std::size_t group) const { return members_.data() + start_[group]; }
  const int* end(std::size_t group) const { return members_.data() + start_[group + 1]; }

 private:
  template <class Same>
  void join_all(const MeshData& mesh, const Positions& x_t0, Same&& end_alike, const Stop& stop);
  void join(int v, int w);
  int root(int v);
  void number();

  std::vector<int> group_, members_;
  std::vector<std::size_t> start_;
};

}  // namespace onset
