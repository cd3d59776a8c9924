// One pair as scalar code sees it: corner differences scaled by a power of two.
#pragma once

#include "scene/motion/motion.hpp"

namespace onset {

// Corners j = p - v_j (vertex-face) or 2i + j = a_i - b_j (edge-edge) as c[end][corner][axis], in units of
// `unit`, the largest component in [1, 2).
struct Corners {
  int count = 0;
  double c[2][4][3] = {};
  // The edges e[end][i] in the same units, one rounding each: a, b or v0 v1, v1 v2, v2 v0.
  double e[2][3][3] = {};
  double unit = 1;
  // An upper bound of the Euclidean norm of the largest magnitudes by axis.
  double rho = 0;

  // Computes the corners at t within 3u rho beyond their own u rho; exact at both ends.
  void at(double t, double (&out)[4][3]) const;
};

Corners make_corners(PairKind kind, const Motion& motion, const int (&vertices)[4]);

}  // namespace onset
