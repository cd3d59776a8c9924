// One pair as scalar code sees it: corner differences scaled by a power of two.
#pragma once

#include "scene/motion/motion.hpp"

namespace onset {

// Vertex-face: corner j = p - v_j, count 3. Edge-edge: corner 2i + j = a_i - b_j, count 4.
// c[end][corner][axis], the largest component in [1, 2): c holds (model length) / unit.
struct Corners {
  int count = 0;
  double c[2][4][3] = {};
  // The pair's edges, scaled alike, one rounding each: e[end][i]; edge-edge a, b; vertex-face v0 v1, v1 v2,
  // v2 v0.
  double e[2][3][3] = {};
  double unit = 1;
  double rho = 0;  // upper bound of the Euclidean norm of the per-axis largest magnitudes

  // Corner k at time t, exact at both ends; error at most 3u rho beyond the corners' own u rho.
  void at(double t, double (&out)[4][3]) const;
};

Corners make_corners(PairKind kind, const Motion& motion, const int (&vertices)[4]);

}  // namespace onset
