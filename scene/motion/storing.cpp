#include "scene/motion/storing.hpp"

#include <algorithm>
#include <cmath>

namespace onset {

double rounding_of_distances(const Motion& m) {
  double largest = m.largest_elsewhere;
  for (int v = 0; v < m.num_vertices; ++v)
    for (const double* x : {m.t0(v), m.t1(v)})
      for (int a = 0; a < 3; ++a) largest = std::max(largest, std::fabs(x[a]));
  return (kStoring * largest + 0x1p-1070) * (1 + 0x1p-50);
}

}  // namespace onset
