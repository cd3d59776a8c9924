#include "broadphase/diagonals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "broadphase/interval.hpp"
#include "broadphase/motion_box.hpp"

namespace onset {
namespace {

// Of the vertices of a primitive: an interval a coordinate.
struct Corners {
  std::array<std::array<Interval, 3>, 3> x;
  std::size_t count;
};

Corners corners(const BroadPhaseInput& input, Primitive kind, int id, bool at_end) {
  const std::array<int, 3> vertices = primitive_vertices(input.mesh, kind, id);
  Corners c{{}, kind == Primitive::vertex ? 1u : kind == Primitive::edge ? 2u : 3u};
  for (std::size_t k = 0; k < c.count; ++k)
    for (std::size_t i = 0; i < 3; ++i) {
      const double t0 = input.motion.t0(vertices[k])[i], t1 = input.motion.t1(vertices[k])[i];
      c.x[k][i] = at_end ? at_t_max(t0, t1, input.t_max) : Interval{t0, t0};
    }
  return c;
}

// How far a primitive extends along a diagonal from a point.
Interval extent_along(int diagonal, const Corners& c, const Corners& from) {
  Interval most{INFINITY, -INFINITY};
  for (std::size_t v = 0; v < c.count; ++v) {
    Interval sum{0, 0};
    for (std::size_t i = 0; i < 3; ++i) {
      const int sign = kDiagonal[diagonal][i];
      const double origin = from.x[0][i].lo, lo = c.x[v][i].lo - origin, hi = c.x[v][i].hi - origin;
      if (sign > 0) sum = {sum.lo + lo, sum.hi + hi};
      if (sign < 0) sum = {sum.lo - hi, sum.hi - lo};
    }
    most = {std::min(most.lo, sum.lo), std::max(most.hi, sum.hi)};
  }
  return most;
}
// Returns the largest sum of magnitudes of the differences that this sums.
double largest_sum(const Corners& c, const Corners& from) {
  double largest = 0;
  for (std::size_t v = 0; v < c.count; ++v) {
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double origin = from.x[0][i].lo;
      sum += std::max(std::fabs(c.x[v][i].lo - origin), std::fabs(c.x[v][i].hi - origin));
    }
    largest = std::max(largest, sum);
  }
  return largest;
}

// Returns the diagonals of `which` along which the second lies beyond the first by more than `reach`, and
// kDiagonals on those along which the first lies beyond the second.
//
// Differences from a vertex round once each, and sums of three twice: a sum errs by 3.01u m, where m is the
// largest sum of magnitudes as computed, and the difference of two by 8.1u m with its own rounding; 32u m is
// 2^-48 m. Nothing of it underflows unless all sums are exact; 2^-1074 covers a subnormal `reach`. Where
// anything overflows, m is infinite, and nothing is apart.
unsigned separating(const Corners& a, const Corners& b, double reach, Norm norm, unsigned which) {
  const double error = std::max(largest_sum(a, a), largest_sum(b, a)) * 0x1p-48 + 0x1p-1074;
  unsigned sides = 0;
  for (int k = 0; k < kDiagonals; ++k) {
    if ((which >> k & 1) == 0) continue;
    const Interval s = extent_along(k, a, a), t = extent_along(k, b, a);
    const double needed = reach * diagonal_reach(norm) + error;
    sides |= unsigned(t.lo - s.hi > needed) << k | unsigned(s.lo - t.hi > needed) << (kDiagonals + k);
  }
  return sides;
}

}  // namespace

// The square root of 2, next to which doubles are 2^-52 apart, and 2^-50 for the product and the sum that
// follow.
double diagonal_reach(Norm norm) { return (norm == Norm::maximum ? 2 : 1.4142135623730952) * (1 + 0x1p-50); }

bool diagonals_apart(const BroadPhaseInput& input, PairKind kind, IdPair pair, unsigned which) {
  const Primitive first = first_primitive(kind), second = second_primitive(kind);
  if (first == second && pair.b < pair.a) std::swap(pair.a, pair.b);  // whoever asks
  const double inflations = widen_up(widened_by(input, first, pair.a), widened_by(input, second, pair.b));
  const double reach = widen_up(inflations, input.diagonals.margin);
  unsigned sides = which | which << kDiagonals;
  if (sides == 0) return false;
  for (const bool at_end : {false, true}) {
    sides &= separating(corners(input, first, pair.a, at_end), corners(input, second, pair.b, at_end), reach,
                        input.diagonals.norm, (sides | sides >> kDiagonals) & 0xff);
    if (sides == 0) return false;
  }
  return true;
}

}  // namespace onset
