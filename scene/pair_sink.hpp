// Pairs by their ids, and how they are handed on: in small batches, consumed where they are produced. Kernels see this file.
#pragma once

#include <cstddef>

#include "onset/result.hpp"

namespace onset {

struct IdPair {
  int a, b;  // vertex_face: vertex, face; edge_edge: edges, a < b; kEdgeFace: edge, face
};

// A plain callback, so that kernels compiled for another instruction set can call it. `pairs` is valid during the call only.
struct PairSink {
  void* context;
  void (*consume)(void* context, const IdPair* pairs, std::size_t count);
  void operator()(const IdPair* pairs, std::size_t count) const { consume(context, pairs, count); }
};

inline constexpr std::size_t kBatchSize = 1024;  // pairs a batch holds at most

}  // namespace onset
