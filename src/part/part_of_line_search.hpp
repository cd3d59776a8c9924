// What one part of a scene finds on a line search, before all parts are known.
#pragma once

#include <array>
#include <optional>
#include <utility>

#include "onset/export.hpp"
#include "onset/line_search.hpp"
#include "src/shared/pair_traversal.hpp"

namespace onset {

// By kind: the least share of its gap that a pair is sure to keep, and the first pair with that.
struct LeastShare {
  double share = 1;
  IdPair pair{-1, -1};
};
using LeastShares = std::array<LeastShare, std::size_t(PairKind::vertex_plane) + 1>;

struct FoundOnLine {
  TraversalResult traversal;
  LeastShares least;
  Stats stats;
  // Why it ended early; free where it did not.
  Outcome outcome = Outcome::free;
};

// Says which share is kept once the step is known, and returns the pair that keeps less than was asked for.
ONSET_API std::optional<std::pair<PairKind, IdPair>> put_shares(const LeastShares& least,
                                                                LineSearchStep& step);

class ONSET_API PartOfLineSearch {
 public:
  // How the constructor ended.
  static const StepResult& start(const LineSearch& search);
  // Only where that is free. upper: in [0, 1].
  static FoundOnLine find(const LineSearch& search, double upper);
};

}  // namespace onset
