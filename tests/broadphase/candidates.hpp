// The candidates of one broad phase, in an order that can be compared.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "base/instruction_set.hpp"
#include "broadphase/broad_phase.hpp"

namespace onset::tests {

using IdPairs = std::vector<std::pair<int, int>>;

// In the order in which they are emitted, block by block or all at once.
inline IdPairs emitted(const BroadPhase& phase, PairKind kind, std::size_t first, std::size_t last) {
  IdPairs pairs;
  const PairSink sink{&pairs, [](void* context, const IdPair* batch, std::size_t count) {
                        auto& all = *static_cast<IdPairs*>(context);
                        if (count == 0 || count > kBatchSize) throw std::logic_error("batch size");
                        for (std::size_t i = 0; i < count; ++i) all.emplace_back(batch[i].a, batch[i].b);
                      }};
  phase.traverse(kind, first, last, sink);
  return pairs;
}

inline IdPairs sorted(IdPairs pairs) {
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

// Duplicates are kept, so that they show.
inline IdPairs candidates(const BroadPhase& phase, PairKind kind) {
  return sorted(emitted(phase, kind, 0, phase.blocks(kind)));
}

struct Method {
  const char* name;
  BroadPhaseMethod method;
  InstructionSet instruction_set;
};

// All but brute force.
inline std::vector<Method> methods() {
  std::vector<Method> all{{"bvh scalar", BroadPhaseMethod::bvh, InstructionSet::scalar},
                          {"hash scalar", BroadPhaseMethod::hash, InstructionSet::scalar}};
  if (has_avx2()) {
    all.push_back({"bvh avx2", BroadPhaseMethod::bvh, InstructionSet::avx2});
    all.push_back({"hash avx2", BroadPhaseMethod::hash, InstructionSet::avx2});
  }
  return all;
}

}  // namespace onset::tests
