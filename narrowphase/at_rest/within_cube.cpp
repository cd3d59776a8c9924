#include "narrowphase/at_rest/within_cube.hpp"

#include <algorithm>
#include <cmath>

#include "narrowphase/vec.hpp"

namespace onset {
namespace {

// The polygon of differences and the cube of half width d, scaled so that none is above 4. Underflow is far
// less than the rounding that is counted here.
struct Differences {
  Vec corner[4];
  int count;
  double d;

  Differences(PairKind kind, const double* const (&x)[4], double half_width) {
    double size = half_width;
    for (const double* p : x)
      for (int k = 0; k < 3; ++k) size = std::max(size, std::fabs(p[k]));
    const double scale = size > 0 ? std::ldexp(1.0, std::min(-std::ilogb(size), 1000)) : 1;
    const auto at = [&](int i) { return Vec{{x[i][0] * scale, x[i][1] * scale, x[i][2] * scale}}; };
    count = kind != PairKind::edge_edge ? 3 : 4;
    if (kind != PairKind::edge_edge)
      for (int i = 0; i < 3; ++i) corner[i] = at(0) - at(i + 1);
    else
      corner[0] = at(0) - at(2), corner[1] = at(0) - at(3), corner[2] = at(1) - at(3),
      corner[3] = at(1) - at(2);
    d = half_width * scale;
  }

  // Tells whether the polygon is beyond the cube in direction m, any doubles. Products err by 13u |m|
  // |corner| in the largest coordinates, the reach d |m|_1 by 5u (docs/theory.md, §19).
  bool beyond(const Vec& m) const {
    const double reach = d * sum_of_magnitudes(m);
    double least = INFINITY, most = -INFINITY, farthest = 0;
    for (int i = 0; i < count; ++i) {
      const double h = dot(m, corner[i]);
      least = std::min(least, h), most = std::max(most, h),
      farthest = std::max(farthest, largest_component(corner[i]));
    }
    const double limit = reach * (1 + 0x1p-48) + 0x1p-48 * largest_component(m) * farthest + 0x1p-1000;
    return least > limit || most < -limit;
  }
};

}  // namespace

// Convex bodies are apart where a face of one, or an edge of each, spans a plane between them.
bool within_cube(PairKind kind, const double* const (&x)[4], double d) {
  const Differences p(kind, x, d);
  static constexpr Vec kAxes[3] = {{{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}};
  for (const Vec& axis : kAxes)
    if (p.beyond(axis)) return false;
  if (p.beyond(cross(p.corner[1] - p.corner[0], p.corner[2] - p.corner[0]))) return false;
  for (int i = 0; i < 3; ++i)
    for (const Vec& axis : kAxes)
      if (p.beyond(cross(p.corner[(i + 1) % 3] - p.corner[i], axis))) return false;
  return true;
}

}  // namespace onset
