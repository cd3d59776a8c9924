// What a closed segment and a closed triangle have in common, for any exact ring Q: the part of the segment
// on which linear inequalities hold. Neither orientations nor projections, so that it shares nothing with the
// library but the definition.
#pragma once

#include <onset/intersections.hpp>
#include <optional>

#include "tests/oracle/arithmetic/geometry.hpp"

namespace onset::oracle {

// The t in [0, 1] with a + b t >= 0 for all that was asked for: from `lo` to `hi`, fractions.
template <class Q>
struct LinearPart {
  Q lo = 0, lo_of = 1, hi = 1, hi_of = 1;
  bool empty = false;

  void at_least_zero(const Q& a, const Q& b) {
    if (b == 0) {
      empty = empty || a < 0;
    } else if (b > 0) {  // t >= -a / b
      if (-a * lo_of > lo * b) lo = -a, lo_of = b;
    } else {  // t <= a / -b
      if (a * hi_of < hi * -b) hi = a, hi_of = -b;
    }
    empty = empty || lo * hi_of > hi * lo_of;
  }
  void zero(const Q& a, const Q& b) { at_least_zero(a, b), at_least_zero(-a, -b); }
  bool single() const { return lo * hi_of == hi * lo_of; }
};

// A form that is linear along the segment, from its values at both ends.
template <class Q>
struct AlongSegment {
  Q start, slope;
  AlongSegment(const Vector<Q>& m, const Vector<Q>& from, const Vector<Q>& e0, const Vector<Q>& e1)
      : start(dot<Q>(m, e0 - from)), slope(dot<Q>(m, e1 - e0)) {}
};

// Of a triangle with area and its normal n.
template <class Q>
std::optional<IntersectionKind> with_triangle(const std::array<Vector<Q>, 2>& e,
                                              const std::array<Vector<Q>, 3>& f, const Vector<Q>& n) {
  LinearPart<Q> part;
  const AlongSegment<Q> height(n, f[0], e[0], e[1]);
  part.zero(height.start, height.slope);
  std::vector<AlongSegment<Q>> sides;
  for (std::size_t i = 0; i < 3 && !part.empty; ++i) {
    sides.emplace_back(cross<Q>(n, f[(i + 1) % 3] - f[i]), f[i], e[0], e[1]);
    part.at_least_zero(sides.back().start, sides.back().slope);
  }
  if (part.empty) return std::nullopt;
  if (e[0] == e[1]) return IntersectionKind::touching;
  if (!part.single()) return IntersectionKind::overlapping;
  bool inside = part.lo > 0 && part.lo < part.lo_of && height.slope != 0;
  for (const AlongSegment<Q>& s : sides) inside = inside && s.start * part.lo_of + s.slope * part.lo > 0;
  return inside ? IntersectionKind::crossing : IntersectionKind::touching;
}

// Of the segment or point that a triangle without area is: its longest side.
template <class Q>
std::optional<IntersectionKind> with_segment(const std::array<Vector<Q>, 2>& e,
                                             const std::array<Vector<Q>, 3>& f) {
  std::size_t longest = 0;
  const auto side = [&](std::size_t i) { return f[(i + 1) % 3] - f[i]; };
  for (std::size_t i = 1; i < 3; ++i)
    if (dot<Q>(side(i), side(i)) > dot<Q>(side(longest), side(longest))) longest = i;
  const Vector<Q> p = f[longest], v = side(longest);
  LinearPart<Q> part;
  if (dot<Q>(v, v) == 0) {
    for (std::size_t k = 0; k < 3; ++k) part.zero(e[0][k] - p[k], e[1][k] - e[0][k]);
  } else {
    const Vector<Q> start = cross<Q>(e[0] - p, v), slope = cross<Q>(e[1] - e[0], v);
    for (std::size_t k = 0; k < 3; ++k) part.zero(start[k], slope[k]);
    const AlongSegment<Q> from(v, p, e[0], e[1]);
    part.at_least_zero(from.start, from.slope);
    part.at_least_zero(dot<Q>(v, v) - from.start, -from.slope);
  }
  if (part.empty) return std::nullopt;
  return e[0] == e[1] || part.single() ? IntersectionKind::touching : IntersectionKind::overlapping;
}

// None: they are apart.
template <class Q>
std::optional<IntersectionKind> edge_face(const std::array<Vector<Q>, 2>& e,
                                          const std::array<Vector<Q>, 3>& f) {
  const Vector<Q> n = cross<Q>(f[1] - f[0], f[2] - f[0]);
  if (n == Vector<Q>{0, 0, 0}) return with_segment<Q>(e, f);
  return with_triangle<Q>(e, f, n);
}

}  // namespace onset::oracle
