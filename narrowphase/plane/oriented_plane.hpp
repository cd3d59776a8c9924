// A plane of a mesh in the order of axes of a motion, and the cheap test of many vertices.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/planes.hpp"

namespace onset {

// As MeshPlane.
struct OrientedPlane {
  std::array<double, 3> normal, scaled, magnitude;
  double offset, scaled_offset;
  int exponent;
  // What a separation is multiplied by to compare it with n.x - offset, scaled: at least that, at most that.
  double norm, norm_below;

  OrientedPlane(const MeshPlane& plane, const std::array<int, 3>& axes, bool maximum_norm)
      : offset(plane.offset),
        scaled_offset(plane.scaled_offset),
        exponent(plane.exponent),
        norm(maximum_norm ? plane.sum : plane.length),
        norm_below(norm * (1 - 0x1p-48)) {
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t b = std::size_t(axes[a]);
      normal[a] = plane.normal[b], scaled[a] = plane.scaled[b], magnitude[a] = plane.magnitude[b];
    }
  }
};

// f = n.x - offset at both ends of a motion, scaled and rounded, and more than what can make it differ from
// the exact one, or what storing can change it by, four times.
//
// With S = sum |n_a| max(|x_a|) + |offset|: f carries 4 roundings, 4u S. Storing changes a coordinate by at
// most 5.25u of its largest magnitude (docs/steps.md), f by 5.25u S, four times that is 21u S. 64u S leaves
// the rest for the roundings of what is compared with f. What underflows is less than 2^-1000, but for a
// component of n times a coordinate, which `magnitude` has (docs/planes.md).
struct PlaneSpan {
  double start, end, error;

  PlaneSpan(const OrientedPlane& n, const double* x0, const double* x1) {
    start = ((n.scaled[0] * x0[0] + n.scaled[1] * x0[1]) + n.scaled[2] * x0[2]) - n.scaled_offset;
    end = ((n.scaled[0] * x1[0] + n.scaled[1] * x1[1]) + n.scaled[2] * x1[2]) - n.scaled_offset;
    double size = std::fabs(n.scaled_offset);
    for (int a = 0; a < 3; ++a)
      size += n.magnitude[std::size_t(a)] * std::max(std::fabs(x0[a]), std::fabs(x1[a]));
    error = 0x1p-47 * size + 0x1p-1000;
  }

  // Says whether the vertex keeps `separation`, and the share `kept` in [0, 1) of what it has beyond that,
  // and four times what storing can change, during the whole motion. Neither NaN nor infinities do.
  bool stays_beyond(const OrientedPlane& n, double separation, double kept) const {
    const double least = separation * n.norm, gap = start - least;
    return gap - kept * gap > error && end - kept * start > least + error && end < INFINITY;
  }
};

// When a vertex that does not stay beyond can limit a step, between bounds; infinite for never.
struct PlaneTimes {
  // Of the contact, and of a step that is stored; it is not known to be no later than the latter two.
  double contact_from, stored_from, contact_by = INFINITY, stored_by = INFINITY;

  PlaneTimes(const PlaneSpan& s, const OrientedPlane& n, double separation, double kept) {
    const double least = separation * n.norm + s.error, share = kept * s.start;
    const double most = separation * n.norm_below - s.error;
    contact_from = above_until(s.start - least, s.end - least);
    stored_from = above_until((s.start - share) - least, (s.end - share) - least);
    if (!(s.start > least) || !(s.end < most)) return;
    const double share_below = kept * (s.start - least);
    contact_by = below_from(s.start - most, s.end - most);
    stored_by = below_from((s.start - most) - share_below, (s.end - most) - share_below);
  }

 private:
  // Bounds of the root of the line from a at 0 to b at 1; the quotient errs by 3u. A number that is infinite,
  // or none, tells nothing: 0 is no later than any time, and infinity no earlier.
  static double above_until(double a, double b) {
    if (!(a > 0) || !(std::max(a, b) < INFINITY)) return 0;
    if (b > 0) return INFINITY;
    const double t = a / (a - b) * (1 - 0x1p-49);
    return t > 0 ? t : 0;
  }
  static double below_from(double a, double b) {
    if (!(a > 0) || !(b <= 0) || !(a - b < INFINITY)) return INFINITY;
    return a / (a - b) * (1 + 0x1p-49);
  }
};

}  // namespace onset
