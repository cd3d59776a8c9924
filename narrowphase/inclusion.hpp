// The paper's inclusion root finder (Algorithm 2; minimum separation, section 6): the definition and the last
// resort.
#pragma once

#include "base/unit_roundoff.hpp"

#include <cstdint>

#include "narrowphase/corners.hpp"

namespace onset {

struct InclusionInput {
  const Corners& corners;
  double t_begin = 0;     // searches [t_begin, 1]
  double separation = 0;  // d, scaled as the corners are
  double tolerance = 0;   // delta, scaled, > 0: boxes of width delta/2 that may hold a root are accepted
  bool maximum_norm = false;
  std::int64_t max_checks = 1'000'000;
};

struct InclusionResult {
  enum class End { free, contact, max_checks } end = End::free;
  double t = 1;             // certified apart on [t_begin, t); contact: some point is within d + delta near t
  double distance = 0;      // scaled upper bound of the distance at t (contact and max_checks)
  std::int64_t checks = 0;  // boxes examined
};

// Best-first in time, deepest first on ties, so the first accepted box is the answer and a spent budget
// returns the smallest time left: conservative always. Memory is bounded by kInclusionBoxes boxes whatever
// the budget; a search that would need more ends as if its budget were spent.
inline constexpr int kInclusionBoxes = 1 << 14;
InclusionResult find_first_inclusion(const InclusionInput& input);

}  // namespace onset
