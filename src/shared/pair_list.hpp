// Pairs found once, streamed again for every step size: a source that only remembers.
#pragma once

#include <vector>

#include "broadphase/broad_phase.hpp"
#include "narrowphase/narrow_phase.hpp"
#include "src/shared/budget.hpp"

namespace onset {

class HeldPairs final : public PairSource {
 public:
  std::size_t blocks(PairKind kind) const override;
  void traverse(PairKind kind, std::size_t first, std::size_t last, const PairSink& sink) const override;

  const std::vector<IdPair>& of(PairKind kind) const {
    return kind == PairKind::vertex_face ? vertex_face_ : edge_edge_;
  }
  std::vector<IdPair>& of(PairKind kind) { return kind == PairKind::vertex_face ? vertex_face_ : edge_edge_; }
  PairCounts counts() const { return {std::int64_t(vertex_face_.size()), std::int64_t(edge_edge_.size())}; }

 private:
  std::vector<IdPair> vertex_face_, edge_edge_;
};

// What the culls of `narrow` cannot certify goes into `held`.
struct Holder {
  const NarrowPhase& narrow;
  HeldPairs& held;
};

// One traversal of `broad` for all holders; each holds its pairs in the order of ids. No more than `most` in all, or none: then
// returns false. Ends early where the budget is spent.
bool hold(const PairSource& broad, const std::vector<Holder>& holders, std::int64_t most, Budget& budget);

}  // namespace onset
