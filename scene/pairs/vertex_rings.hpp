// Vertices that are near each other on the mesh, along its edges.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "onset/export.hpp"
#include "scene/pair_sink.hpp"

namespace onset {

struct MeshData;

// The edges of a mesh by vertex, without points.
class ONSET_API EdgeGraph {
 public:
  explicit EdgeGraph(const MeshData& mesh);
  const int* begin(int v) const { return neighbours_.data() + first_[std::size_t(v)]; }
  const int* end(int v) const { return neighbours_.data() + first_[std::size_t(v) + 1]; }

 private:
  std::vector<std::size_t> first_;
  std::vector<int> neighbours_;
};

// Breadth-first searches on one graph, each in the memory of the last.
class ONSET_API RingSearch {
 public:
  RingSearch(const EdgeGraph& graph, int vertices) : graph_(graph), seen_(std::size_t(vertices), -1) {}
  // Returns the vertices within `rings` edges of a or b, each once, in the order in which they are met. Valid
  // up to the next call.
  const std::vector<int>& around(int a, int b, int rings);

 private:
  const EdgeGraph& graph_;
  std::vector<int> seen_;  // by vertex: the search that met it last
  std::vector<int> met_;
  int search_ = -1;
};

// Which vertices are within so many edges of each other.
class ONSET_API VertexRings {
 public:
  // rings >= 1. Throws std::invalid_argument where more than `most` pairs of vertices are that near.
  VertexRings(const MeshData& mesh, int rings, std::size_t most);
  // Takes the pairs of vertices v < w that are so near.
  VertexRings(int vertices, int rings, std::vector<std::array<int, 2>> near);
  static constexpr std::size_t kMostPairs = std::size_t(1) << 27;

  int rings() const { return rings_; }
  // Says whether two different vertices are joined by at most `rings` edges.
  bool near(int v, int w) const;
  // Says whether an edge leads anywhere from v.
  bool has_neighbours(int v) const { return joined_[std::size_t(v)]; }

 private:
  int rings_;
  // The larger ids near each vertex, sorted: row v is [first_[v], first_[v + 1]).
  std::vector<std::size_t> first_;
  std::vector<int> larger_;
  std::vector<bool> joined_;
};

// Says whether a vertex of one primitive is near a vertex of the other, or the same.
bool within_rings(const MeshData& mesh, PairKind kind, int a, int b);

// Counts the pairs of a kind that are within mesh.rings and that `counts` says yes to, from any thread; of
// two edges each once, the smaller id first. O(pairs within the rings).
std::int64_t count_within_rings(const MeshData& mesh, PairKind kind,
                                const std::function<bool(int a, int b)>& counts);

}  // namespace onset
