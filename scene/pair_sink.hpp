// How the broad phase hands pairs on: small batches, consumed where they are produced.
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

// Anything that streams pairs.
class PairSource {
 public:
  virtual ~PairSource() = default;
  // Units of work that may be traversed concurrently; their number and content do not depend on the thread
  // count. None where a motion is not finite or out of range.
  virtual std::size_t blocks(PairKind kind) const = 0;
  // Streams the candidates of blocks [first, last) in batches of at most kBatchSize.
  virtual void traverse(PairKind kind, std::size_t first, std::size_t last, const PairSink& sink) const = 0;
};

class PairBatch {
 public:
  explicit PairBatch(const PairSink& sink) : sink_(sink) {}
  PairBatch(const PairBatch&) = delete;
  PairBatch& operator=(const PairBatch&) = delete;

  void add(int a, int b) {
    pairs_[count_++] = {a, b};
    if (count_ == kBatchSize) flush();
  }
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
