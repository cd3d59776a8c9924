#include "narrowphase/at_rest/edges_in_plane.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace onset {
namespace {

// Returns the side of the line from a to b that p is certainly on; 0: open, also where anything overflows.
// Differences round once, products err by 3u and their difference by 8u of the largest components in all,
// 2^-49 = 16u; 2^-1070 covers underflow.
int certain_side(const double* a, const double* b, const double* p) {
  const double ux = b[0] - a[0], uy = b[1] - a[1], vx = p[0] - a[0], vy = p[1] - a[1];
  const double area = ux * vy - uy * vx;
  const double bound =
      0x1p-49 * (std::max(std::fabs(ux), std::fabs(uy)) * std::max(std::fabs(vx), std::fabs(vy))) + 0x1p-1070;
  if (!(std::fabs(area) > bound && std::fabs(area) <= std::numeric_limits<double>::max())) return 0;
  return area > 0 ? 1 : -1;
}

}  // namespace

EdgeFace edges_in_plane(const std::array<const double*, 2>& e, const std::array<const double*, 2>& f) {
  const int f0 = certain_side(e[0], e[1], f[0]), f1 = certain_side(e[0], e[1], f[1]);
  const int e0 = certain_side(f[0], f[1], e[0]), e1 = certain_side(f[0], f[1], e[1]);
  if (f0 * f1 > 0 || e0 * e1 > 0) return EdgeFace::apart;
  if (f0 * f1 < 0 && e0 * e1 < 0) return EdgeFace::crossing;
  const EdgeFace found = edge_face({{e[0], e[1]}, {f[0], f[1], f[1]}});
  if (found != EdgeFace::touching) return found;
  const bool at_an_end = exactly_collinear(e[0], e[1], f[0]) || exactly_collinear(e[0], e[1], f[1]) ||
                         exactly_collinear(f[0], f[1], e[0]) || exactly_collinear(f[0], f[1], e[1]);
  return at_an_end ? EdgeFace::touching : EdgeFace::crossing;
}

}  // namespace onset
