#include "narrowphase/corners.hpp"

#include <algorithm>
#include <cmath>

namespace onset {
namespace {

// Returns the power that brings x into [1, 2); 0 and subnormal numbers get the largest, as in the kernels.
double inverse_power_of_two(double x) {
  const int exponent = x < 0x1p-1022 ? -1023 : std::ilogb(x);
  return std::ldexp(1.0, -exponent);
}

}  // namespace

Corners make_corners(PairKind kind, const Motion& motion, const int (&v)[4]) {
  Corners r;
  r.count = kind == PairKind::edge_edge ? 4 : 3;
  double largest = 0;
  for (int end = 0; end < 2; ++end)
    for (int k = 0; k < r.count; ++k) {
      const int first = r.count == 4 ? v[k / 2] : v[0];
      const int second = r.count == 4 ? v[2 + k % 2] : v[1 + k];
      const double* p = end == 0 ? motion.t0(first) : motion.t1(first);
      const double* q = end == 0 ? motion.t0(second) : motion.t1(second);
      for (int a = 0; a < 3; ++a) {
        r.c[end][k][a] = p[a] - q[a];
        largest = std::max(largest, std::fabs(r.c[end][k][a]));
      }
    }
  const double scale = inverse_power_of_two(largest);
  for (int end = 0; end < 2; ++end)
    for (int i = 0; i < r.count - (r.count == 4 ? 2 : 0); ++i) {
      const int from = r.count == 4 ? v[2 * i] : v[1 + i],
                to = r.count == 4 ? v[2 * i + 1] : v[1 + (i + 1) % 3];
      for (int a = 0; a < 3; ++a) {
        const double* p = end == 0 ? motion.t0(from) : motion.t1(from);
        const double* q = end == 0 ? motion.t0(to) : motion.t1(to);
        r.e[end][i][a] = (q[a] - p[a]) * scale;
      }
    }
  double R[3] = {};
  for (auto& end : r.c)
    for (int k = 0; k < r.count; ++k)
      for (int a = 0; a < 3; ++a) {
        end[k][a] *= scale;
        R[a] = std::max(R[a], std::fabs(end[k][a]));
      }
  r.unit = 1 / scale;
  r.rho = std::sqrt(R[0] * R[0] + R[1] * R[1] + R[2] * R[2]) * (1 + 0x1p-50);
  return r;
}

void Corners::at(double t, double (&out)[4][3]) const {
  for (int k = 0; k < count; ++k)
    for (int a = 0; a < 3; ++a) out[k][a] = (1 - t) * c[0][k][a] + t * c[1][k][a];
}

}  // namespace onset
