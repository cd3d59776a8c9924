#include "src/trajectory/crossing.hpp"

#include <algorithm>
#include <cmath>

namespace onset {
namespace {

// Every operation rounds outward by more than it can err: u of the result, or 2^-1074.
struct Range {
  double lo, hi;
};
Range outward(double lo, double hi) {
  return {lo - std::fabs(lo) * 0x1p-52 - 0x1p-1070, hi + std::fabs(hi) * 0x1p-52 + 0x1p-1070};
}
Range operator+(const Range& a, const Range& b) { return outward(a.lo + b.lo, a.hi + b.hi); }
Range operator-(const Range& a, const Range& b) { return outward(a.lo - b.hi, a.hi - b.lo); }
Range operator*(const Range& a, const Range& b) {
  const double p[4] = {a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi};
  return outward(*std::min_element(p, p + 4), *std::max_element(p, p + 4));
}
// 0 where it is not known, or NaN.
int sign(const Range& r) { return r.lo > 0 ? 1 : r.hi < 0 ? -1 : 0; }

using RangeVec = std::array<Range, 3>;

RangeVec minus(const VertexBox& a, const VertexBox& b) {
  RangeVec r;
  for (std::size_t i = 0; i < 3; ++i) r[i] = Range{a.lo[i], a.hi[i]} - Range{b.lo[i], b.hi[i]};
  return r;
}
RangeVec cross(const RangeVec& a, const RangeVec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Range dot(const RangeVec& a, const RangeVec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// The two vectors of the pair that span the plane it meets in.
RangeVec normal(PairKind kind, const PairBoxes& x) {
  if (kind == PairKind::vertex_face) return cross(minus(x[2], x[1]), minus(x[3], x[1]));
  return cross(minus(x[1], x[0]), minus(x[3], x[2]));
}
int sign_of_volume(PairKind kind, const PairBoxes& x) {
  const std::size_t other = kind == PairKind::vertex_face ? 1 : 2;
  return sign(dot(minus(x[0], x[other]), normal(kind, x)));
}

// The middle of a normal of any length, as a direction without width.
RangeVec direction(const RangeVec& n) {
  RangeVec r;
  for (std::size_t i = 0; i < 3; ++i) r[i].lo = r[i].hi = 0.5 * (n[i].lo + n[i].hi);
  return r;
}

// On which side of the line from a to b is c, seen along n?
int side(const VertexBox& a, const VertexBox& b, const VertexBox& c, const RangeVec& n) {
  return sign(dot(cross(minus(b, a), minus(c, a)), n));
}

}  // namespace

bool is_certain_to_cross(PairKind kind, const PairBoxes& first, const PairBoxes& last,
                         const PairBoxes& between) {
  if (sign_of_volume(kind, first) * sign_of_volume(kind, last) != -1) return false;
  const PairBoxes& x = between;
  const RangeVec n = direction(normal(kind, x));
  if (kind == PairKind::vertex_face) {
    const int s = side(x[1], x[2], x[0], n);
    return s != 0 && side(x[2], x[3], x[0], n) == s && side(x[3], x[1], x[0], n) == s;
  }
  return side(x[0], x[1], x[2], n) * side(x[0], x[1], x[3], n) == -1 &&
         side(x[2], x[3], x[0], n) * side(x[2], x[3], x[1], n) == -1;
}

}  // namespace onset
