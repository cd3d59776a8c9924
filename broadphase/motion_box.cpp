#include "broadphase/motion_box.hpp"

#include <algorithm>

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

std::size_t primitive_count(const MeshData& mesh, Primitive kind) {
  switch (kind) {
    case Primitive::edge:
      return mesh.edges.size();
    case Primitive::face:
      return mesh.faces.size();
    default:
      return std::size_t(mesh.num_vertices);
  }
}

double primitive_inflation(const BroadPhaseInput& input, Primitive kind, int id) {
  const std::vector<double>& thickness = input.mesh.thickness;
  if (thickness.empty()) return input.inflation;
  double largest = 0;
  for (int v : primitive_vertices(input.mesh, kind, id))
    largest = std::max(largest, thickness[std::size_t(v)]);
  return widen_up(input.inflation, largest);
}

MotionBox motion_box(const BroadPhaseInput& input, Primitive kind, int id) {
  const std::array<int, 3> vertices = primitive_vertices(input.mesh, kind, id);
  const double r = primitive_inflation(input, kind, id);
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

std::vector<MotionBox> motion_boxes(const BroadPhaseInput& input, Primitive kind) {
  std::vector<MotionBox> boxes(primitive_count(input.mesh, kind));
  parallel_ranges(boxes.size(), 1024, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) boxes[i] = motion_box(input, kind, int(i));
  });
  return boxes;
}

bool boxes_pass(BoxTest test, const MotionBox& a, const MotionBox& b) {
  return test == BoxTest::swept ? swept_overlap(a, b) : motion_overlap(a, b);
}

bool share_vertex(const MeshData& mesh, PairKind kind, int a, int b) {
  const auto first = primitive_vertices(mesh, first_primitive(kind), a);
  const auto second = primitive_vertices(mesh, second_primitive(kind), b);
  for (int v : first)
    if (std::find(second.begin(), second.end(), v) != second.end()) return true;
  return false;
}

}  // namespace onset
