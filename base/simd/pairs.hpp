// A list of pairs of ints that is written a pack at a time, without branches; for kernel texts.
#pragma once

#include "base/assert.hpp"
#include "base/simd/pack.hpp"

namespace onset {
namespace ONSET_ISA {
namespace {

// Entries are written eight at a time, so there is room for eight more than count.
constexpr int kCapacity = 256;

struct Pairs {
  int a[kCapacity + kLanes], b[kCapacity + kLanes];
  int count = 0;

  bool full() const { return count > kCapacity - kLanes; }
  void add(I8 as, I8 bs, int lanes) {
    ONSET_ASSERT(count <= kCapacity);
    as.store(a + count), bs.store(b + count);
    count += count_lanes(lanes);
  }
};

}  // namespace
}  // namespace ONSET_ISA
}  // namespace onset
