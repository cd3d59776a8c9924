// Pairs of ids and the callback that hands them on in batches; kernels include this.
#pragma once

#include <cstddef>

#include "base/stop.hpp"
#include "onset/result.hpp"

namespace onset {

// A pair by its ids: vertex and face, two edges with a < b, or edge and face (kEdgeFace).
struct IdPair {
  int a, b;
};

// Receives batches of pairs. It is a plain callback, so that a kernel compiled for another instruction set
// can call it. `pairs` is valid during the call only.
struct PairSink {
  void* context;
  void (*consume)(void* context, const IdPair* pairs, std::size_t count);
  // Asked by whoever streams pairs, also where none passes its tests; what is left then need not come.
  Stop stop{};
  void operator()(const IdPair* pairs, std::size_t count) const { consume(context, pairs, count); }
};

// The most pairs that a batch holds.
inline constexpr std::size_t kBatchSize = 1024;

}  // namespace onset
