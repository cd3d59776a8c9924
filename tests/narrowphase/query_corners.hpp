// The corners of a query, as scalar certificates take them.
#pragma once

#include "narrowphase/corners.hpp"
#include "tests/queries/query.hpp"

namespace onset::tests {

inline Corners corners_of(const scenes::Query& query) {
  Motion motion;
  motion.num_vertices = 4;
  motion.x = AlignedArray<double>(4 * kMotionStride);
  for (int i = 0; i < 4; ++i)
    for (int a = 0; a < 4; ++a) {
      motion.x[std::size_t(kMotionStride * i + a)] = a < 3 ? query.t0[i][a] : 0;
      motion.x[std::size_t(kMotionStride * i + 4 + a)] = a < 3 ? query.t1[i][a] : 0;
    }
  const int vertices[4] = {0, 1, 2, 3};
  return make_corners(query.kind, motion, vertices);
}

}  // namespace onset::tests
