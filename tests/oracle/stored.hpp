// What becomes of a pair whose positions x0 + s (x1 - x0) are stored as doubles.
#pragma once

#include <cmath>

#include "tests/queries/query.hpp"

namespace onset::oracle {

// The orders of operations in which a simulator may compute x0 + s (x1 - x0).
enum class Rounding { product, fused, weighted };
constexpr Rounding kRoundings[] = {Rounding::product, Rounding::fused, Rounding::weighted};

inline double stored(Rounding how, double x0, double x1, double s) {
  if (how == Rounding::weighted) return (1 - s) * x0 + s * x1;
  const double dx = x1 - x0;
  return how == Rounding::fused ? std::fma(s, dx, x0) : x0 + s * dx;
}
std::array<Point, 4> stored(Rounding how, const scenes::Query& motion, double s);

// Empty, or what happens on the exact motion on [0, s], or on the straight way from its exact end to the
// doubles that are `stored` for it: the pair touches. For pairs that start apart. Exact.
const char* broken_on_the_way(const scenes::Query& motion, double s, const std::array<Point, 4>& stored);

// The sign of (distance of four points at rest) - d, exactly.
int compare_distance_at_rest(PairKind kind, const std::array<Point, 4>& x, double d,
                             Norm norm = Norm::euclidean);

}  // namespace onset::oracle
