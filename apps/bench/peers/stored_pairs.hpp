// The broad phase from positions to a list of all pairs, in memory kept from call to call: what the peers'
// broad phases are compared with.
#pragma once

#include <array>
#include <onset/onset.hpp>
#include <vector>

namespace app {

class StoredPairs {
 public:
  explicit StoredPairs(const onset::Mesh& mesh,
                       onset::BroadPhaseMethod method = onset::BroadPhaseMethod::automatic);
  ~StoredPairs();
  StoredPairs(const StoredPairs&) = delete;

  // Finds and stores every candidate: motion, boxes, tree, pairs, nothing reused but the memory of the lists.
  // In at most `threads` threads, each batch of pairs in lists that no other thread has at the time.
  onset::PairCounts find(const onset::Positions& x_t0, const onset::Positions& x_t1, int threads);

 private:
  struct Lists;  // by kind
  const onset::Mesh* mesh_;
  onset::BroadPhaseMethod method_;
  std::vector<Lists> lists_;
};

}  // namespace app
