// Which settings are worth choosing, and which to choose for a target.
#pragma once

#include <optional>
#include <vector>

#include "onset/trade/subject.hpp"

namespace app {

// Whether `b` is to be preferred to `a` whatever counts: no less accurate in any respect (false positives, or
// all positives where the truth is not known; mean earliness; spent budgets) and faster, the middle halves of
// both measurements apart, or more accurate in one and not slower, its median at most the other's lower
// quartile. Earliness within a tenth counts as equal.
bool dominates(const Measured& b, const Measured& a);

// Indices of the settings that no other dominates, fastest first; of settings that nothing tells apart the
// first, so the base before others. Only those that ask the same question as the base and answer the whole of
// it.
std::vector<std::size_t> pareto_front(const std::vector<Measured>& all);

struct Target {
  std::optional<double> time_us, earliness;  // median time of a call or query; mean, in units of the step
  std::optional<std::int64_t> false_positives, positives, budget;

  bool any() const { return time_us || earliness || false_positives || positives || budget; }
  bool met(const Measured& m) const;
};

// The setting on the front that meets the target: with a target of time alone the most accurate one, else the
// fastest. None where no setting meets it.
std::optional<std::size_t> recommended(const std::vector<Measured>& all, const Target& target);

}  // namespace app
