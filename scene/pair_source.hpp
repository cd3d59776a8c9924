// The interface of whatever streams pairs, and the vertices of a pair.
#pragma once

#include <algorithm>
#include <array>

#include "base/assert.hpp"
#include "scene/mesh_data.hpp"
#include "scene/pair_sink.hpp"
#include "scene/primitive.hpp"

namespace onset {

// Writes the four vertices of a pair, the first side before the second.
inline void put_vertices(const MeshData& mesh, PairKind kind, IdPair p, int* v) {
  ONSET_ASSERT(p.a >= 0 && p.b >= 0);
  if (kind == PairKind::vertex_face) {
    ONSET_ASSERT(p.a < mesh.num_vertices && std::size_t(p.b) < mesh.faces.size());
    const auto& f = mesh.faces[std::size_t(p.b)];
    v[0] = p.a, v[1] = f[0], v[2] = f[1], v[3] = f[2];
  } else if (kind == PairKind::vertex_edge) {  // the edge as a face of two corners
    ONSET_ASSERT(p.a < mesh.num_vertices && std::size_t(p.b) < mesh.edges.size());
    const auto& e = mesh.edges[std::size_t(p.b)];
    v[0] = p.a, v[1] = e[0], v[2] = v[3] = e[1];
  } else {
    ONSET_ASSERT(std::size_t(p.a) < mesh.edges.size() && std::size_t(p.b) < mesh.edges.size());
    std::copy_n(mesh.edges[std::size_t(p.a)].data(), 2, v);
    std::copy_n(mesh.edges[std::size_t(p.b)].data(), 2, v + 2);
  }
}
inline std::array<int, 4> pair_vertices(const MeshData& mesh, PairKind kind, IdPair p) {
  if (kind == PairKind::vertex_plane) return {p.a, -1, -1, -1};
  std::array<int, 4> v;
  put_vertices(mesh, kind, p, v.data());
  return v;
}

// Streams pairs in blocks.
class PairSource {
 public:
  virtual ~PairSource() = default;
  // Returns the number of units of work, which may be traversed concurrently. Their number and content do not
  // depend on the number of threads. There are none where a motion is not finite or out of range.
  virtual std::size_t blocks(PairKind kind) const = 0;
  // Streams the candidates of blocks [first, last) in batches of at most kBatchSize. It asks sink.stop at
  // least once in 2^14 pairs that it looks at.
  virtual void traverse(PairKind kind, std::size_t first, std::size_t last, const PairSink& sink) const = 0;
};

// Returns the number of blocks of all pairs that a step has.
inline std::size_t all_blocks(const PairSource& source) {
  std::size_t blocks = 0;
  for (const PairKind kind : kStepKinds) blocks += source.blocks(kind);
  return blocks;
}

// Collects pairs and hands them on in batches.
class PairBatch {
 public:
  explicit PairBatch(const PairSink& sink) : sink_(sink) {}
  PairBatch(const PairBatch&) = delete;
  PairBatch& operator=(const PairBatch&) = delete;

  // Hands a batch on when it is full.
  void add(int a, int b) {
    ONSET_ASSERT(count_ < kBatchSize && a >= 0 && b >= 0);
    pairs_[count_++] = {a, b};
    if (count_ == kBatchSize) flush();
  }
  // Hands on what is left; must be called at the end.
  void flush() {
    if (count_ > 0) sink_(pairs_, count_);
    count_ = 0;
  }

 private:
  const PairSink& sink_;
  std::size_t count_ = 0;
  IdPair pairs_[kBatchSize];
};

}  // namespace onset
