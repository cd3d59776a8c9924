// How much storing positions in doubles can change distances.
#pragma once

#include "scene/motion/motion.hpp"

namespace onset {

// Storing x_t0 + s (x_t1 - x_t0) in doubles changes the distance of a pair by at most kStoring M + 2^-1070, M
// being the largest coordinate at both ends. That holds for each of the orders of operations in
// docs/theory.md, L47, which proves 17.33u M.
inline constexpr double kStoring = 18.5 * 0x1p-53;

// Stores a coordinate at time t of its linear motion, by one of these orders, and exactly at both ends.
inline double stored_between(double from, double to, double t) {
  return t == 0 ? from : t == 1 ? to : from + t * (to - from);
}

// Returns that bound, rounded up, for all pairs: a length of the model.
double rounding_of_distances(const Motion& m);

// Returns StepResult::rounding. A step is > 0 where all gaps are more than twice this (docs/theory.md, L48).
inline double reported_rounding(double rounding_of_distances) { return rounding_of_distances * 11; }

}  // namespace onset
