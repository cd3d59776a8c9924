// The paper's inclusion root finder (Algorithm 2; section 6), the last resort (docs/theory.md, §11).
#pragma once

#include <cstdint>

#include "base/unit_roundoff.hpp"
#include "narrowphase/corners.hpp"

namespace onset {

struct InclusionInput {
  const Corners& corners;
  // The search covers [t_begin, 1].
  double t_begin = 0;
  // d and delta > 0, scaled as the corners are: boxes of width delta/2 that may hold a root are accepted.
  double separation = 0;
  double tolerance = 0;
  bool maximum_norm = false;
  std::int64_t max_checks = 1'000'000;
};

struct InclusionResult {
  enum class End { free, contact, max_checks } end = End::free;
  // Certified apart on [t_begin, t); contact: some point is within d + delta near t.
  double t = 1;
  // Contact and max_checks: a scaled upper bound of the distance at t.
  double distance = 0;
  std::int64_t checks = 0;  // boxes examined
};

// Takes boxes by their first time, deepest first on ties: the first accepted one is the answer, and a spent
// budget, or kInclusionBoxes boxes in memory, returns the smallest time left.
inline constexpr int kInclusionBoxes = 1 << 14;
InclusionResult find_first_inclusion(const InclusionInput& input);

}  // namespace onset
