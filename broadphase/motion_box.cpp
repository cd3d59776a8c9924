#include "broadphase/motion_box.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>

#include "base/parallel.hpp"
#include "broadphase/interval.hpp"

namespace onset {

namespace {

bool swept_overlap(const MotionBox& a, const MotionBox& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::max(a.hi_t0[i], a.hi_t1[i]) < std::min(b.lo_t0[i], b.lo_t1[i])) return false;
    if (std::max(b.hi_t0[i], b.hi_t1[i]) < std::min(a.lo_t0[i], a.lo_t1[i])) return false;
  }
  return true;
}

bool both_ends_overlap(const MotionBox& a, const MotionBox& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (a.hi_t0[i] < b.lo_t0[i] && a.hi_t1[i] < b.lo_t1[i]) return false;
    if (b.hi_t0[i] < a.lo_t0[i] && b.hi_t1[i] < a.lo_t1[i]) return false;
  }
  return true;
}

// Says whether the boxes, moving linearly, are apart at every time, on one axis or another. The reach hi - lo
// along a direction is positive from its root on, or up to it. kSlack and kLeast cover rounded roots
// (docs/theory.md, L30) and belong to the definition of a candidate.
bool moving_boxes_apart(const MotionBox& a, const MotionBox& b) {
  constexpr double kSlack = 0x1p-45, kLeast = 0x1p-1000;
  double begin = 0, end = 1;
  const auto limit = [&](double s0, double s1) {
    if (s0 < 0)
      begin = std::max(begin, s1 < 0 ? 2.0 : s0 / (s0 - s1));
    else if (s1 < 0)
      end = std::min(end, s0 / (s0 - s1));
  };
  for (std::size_t i = 0; i < 3; ++i) {
    limit(a.hi_t0[i] - b.lo_t0[i], a.hi_t1[i] - b.lo_t1[i]);
    limit(b.hi_t0[i] - a.lo_t0[i], b.hi_t1[i] - a.lo_t1[i]);
  }
  return begin * (1 - kSlack) > end * (1 + kSlack) + kLeast;
}

inline double inflation_of(const BroadPhaseInput& input, Primitive kind, int id) {
  if (part_inflation(input, true) == input.inflation) return input.inflation;
  return part_inflation(input, is_static(input.mesh, kind, id));
}

double widest(const BroadPhaseInput& input, Primitive kind, int id, double inflation) {
  const std::vector<double>& thickness = input.mesh.thickness;
  if (thickness.empty()) return inflation;
  double largest = 0;
  for (int v : primitive_vertices(input.mesh, kind, id))
    largest = std::max(largest, thickness[std::size_t(v)]);
  return widen_up(inflation, largest);
}

}  // namespace

double widened_by(const BroadPhaseInput& input, Primitive kind, int id) {
  return widest(input, kind, id, inflation_of(input, kind, id));
}

MotionBox motion_box(const BroadPhaseInput& input, Primitive kind, int id) {
  return motion_box(input, kind, id, inflation_of(input, kind, id));
}

MotionBox motion_box(const BroadPhaseInput& input, Primitive kind, int id, double inflation) {
  const std::array<int, 3> vertices = primitive_vertices(input.mesh, kind, id);
  const double r = widest(input, kind, id, inflation);
  MotionBox box;
  for (std::size_t i = 0; i < 3; ++i) {
    const double *t0 = input.motion.t0(vertices[0]), *t1 = input.motion.t1(vertices[0]);
    double lo_t0 = t0[i], hi_t0 = t0[i];
    Interval end = at_t_max(t0[i], t1[i], input.t_max);
    for (std::size_t k = 1; k < 3; ++k) {
      const double x0 = input.motion.t0(vertices[k])[i], x1 = input.motion.t1(vertices[k])[i];
      const Interval next = at_t_max(x0, x1, input.t_max);
      lo_t0 = std::min(lo_t0, x0), hi_t0 = std::max(hi_t0, x0);
      end = {std::min(end.lo, next.lo), std::max(end.hi, next.hi)};
    }
    box.lo_t0[i] = widen_down(lo_t0, r), box.hi_t0[i] = widen_up(hi_t0, r);
    box.lo_t1[i] = widen_down(end.lo, r), box.hi_t1[i] = widen_up(end.hi, r);
  }
  return box;
}

MotionBoxes motion_boxes(const BroadPhaseInput& input, Primitive kind, const Stop& stop) {
  MotionBoxes result;
  const PrimitiveFilter& filter = *input.mesh.filter;
  if (filter.all) {
    result.ids.resize(primitive_count(input.mesh, kind));
    std::iota(result.ids.begin(), result.ids.end(), 0);
  } else {
    const std::vector<int>&moving = filter.moving[std::size_t(kind)],
          &still = filter.statics[std::size_t(kind)];
    std::merge(moving.begin(), moving.end(), still.begin(), still.end(), std::back_inserter(result.ids));
  }
  result.boxes.resize(result.ids.size());
  parallel_ranges(result.boxes.size(), 1024, [&](std::size_t first, std::size_t last) {
    each_unless(stop, first, last,
                [&](std::size_t i) { result.boxes[i] = motion_box(input, kind, result.ids[i]); });
  });
  return result;
}

bool boxes_overlap(BoxTest test, const MotionBox& a, const MotionBox& b) {
  if (test == BoxTest::swept) return swept_overlap(a, b);
  return both_ends_overlap(a, b) && !(test == BoxTest::moving && moving_boxes_apart(a, b));
}

bool boxes_overlap(const BroadPhaseInput& input, PairKind kind, IdPair pair) {
  const Primitive first = first_primitive(kind), second = second_primitive(kind);
  const double a = inflation_of(input, first, pair.a), b = inflation_of(input, second, pair.b);
  return boxes_overlap(input.test, motion_box(input, first, pair.a, a), motion_box(input, second, pair.b, b));
}

bool is_candidate(const BroadPhaseInput& input, PairKind kind, IdPair pair) {
  return boxes_overlap(input, kind, pair) && !(input.diagonals.used && diagonals_apart(input, kind, pair));
}

}  // namespace onset
