// Collects pairs and hands them on in batches.
#pragma once

#include "base/pair_sink.hpp"

namespace onset {

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
