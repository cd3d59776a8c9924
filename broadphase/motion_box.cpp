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

bool motion_overlap(const MotionBox& a, const MotionBox& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (a.hi_t0[i] < b.lo_t0[i] && a.hi_t1[i] < b.lo_t1[i]) return false;
    if (b.hi_t0[i] < a.lo_t0[i] && b.hi_t1[i] < a.lo_t1[i]) return false;
  }
  return true;
}

}  // namespace

namespace {

double widest(const BroadPhaseInput& input, Primitive kind, int id, double inflation) {
  const std::vector<double>& thickness = input.mesh.thickness;
  if (thickness.empty()) return inflation;
  double largest = 0;
  for (int v : primitive_vertices(input.mesh, kind, id))
    largest = std::max(largest, thickness[std::size_t(v)]);
  return widen_up(inflation, largest);
}

}  // namespace

MotionBox motion_box(const BroadPhaseInput& input, Primitive kind, int id) {
  const bool alike = part_inflation(input, true) == input.inflation;
  return motion_box(input, kind, id, part_inflation(input, !alike && is_fixed(input.mesh, kind, id)));
}

MotionBox motion_box(const BroadPhaseInput& input, Primitive kind, int id, double inflation) {
  const std::array<int, 3> vertices = primitive_vertices(input.mesh, kind, id);
  const double r = widest(input, kind, id, inflation);
  MotionBox box;
  for (std::size_t i = 0; i < 3; ++i) {
    const double *t0 = input.motion.t0(vertices[0]), *t1 = input.motion.t1(vertices[0]);
    double lo_t0 = t0[i], hi_t0 = t0[i];
    Interval end = at_horizon(t0[i], t1[i], input.horizon);
    for (std::size_t k = 1; k < 3; ++k) {
      const double x0 = input.motion.t0(vertices[k])[i], x1 = input.motion.t1(vertices[k])[i];
      const Interval next = at_horizon(x0, x1, input.horizon);
      lo_t0 = std::min(lo_t0, x0), hi_t0 = std::max(hi_t0, x0);
      end = {std::min(end.lo, next.lo), std::max(end.hi, next.hi)};
    }
    box.lo_t0[i] = widen_down(lo_t0, r), box.hi_t0[i] = widen_up(hi_t0, r);
    box.lo_t1[i] = widen_down(end.lo, r), box.hi_t1[i] = widen_up(end.hi, r);
  }
  return box;
}

MotionBoxes motion_boxes(const BroadPhaseInput& input, Primitive kind) {
  MotionBoxes result;
  const PrimitiveFilter* filter = input.mesh.filter.get();
  if (!filter || filter->all) {
    result.ids.resize(primitive_count(input.mesh, kind));
    std::iota(result.ids.begin(), result.ids.end(), 0);
  } else {
    const std::vector<int>&moving = filter->moving[std::size_t(kind)],
          &fixed = filter->fixed[std::size_t(kind)];
    std::merge(moving.begin(), moving.end(), fixed.begin(), fixed.end(), std::back_inserter(result.ids));
  }
  result.boxes.resize(result.ids.size());
  parallel_ranges(result.boxes.size(), 1024, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) result.boxes[i] = motion_box(input, kind, result.ids[i]);
  });
  return result;
}

bool boxes_pass(BoxTest test, const MotionBox& a, const MotionBox& b) {
  return test == BoxTest::swept ? swept_overlap(a, b) : motion_overlap(a, b);
}

}  // namespace onset
