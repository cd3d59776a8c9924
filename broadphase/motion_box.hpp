// The boxes of a primitive at both ends of its motion, in doubles, and the tests that define candidates.
#pragma once

#include <array>
#include <vector>

#include "broadphase/broad_phase.hpp"
#include "broadphase/diagonals.hpp"
#include "scene/primitive_filter.hpp"

namespace onset {

// Closed boxes at t = 0 and t_max, widened by the inflation and rounded outward; exact without one.
struct MotionBox {
  std::array<double, 3> lo_t0, hi_t0, lo_t1, hi_t1;
};

// Returns by how much primitives are widened, thickness apart.
inline double part_inflation(const BroadPhaseInput& input, bool is_static) {
  return is_static && input.static_inflation >= 0 ? input.static_inflation : input.inflation;
}

// Returns that with the largest thickness of its vertices, rounded up.
double widened_by(const BroadPhaseInput& input, Primitive kind, int id);

// Makes the boxes, widened by `inflation` (else the input's) and the largest thickness of the vertices.
MotionBox motion_box(const BroadPhaseInput& input, Primitive kind, int id, double inflation);
MotionBox motion_box(const BroadPhaseInput& input, Primitive kind, int id);

// The primitives that take part, in the order of ids, with their boxes.
struct MotionBoxes {
  std::vector<int> ids;
  std::vector<MotionBox> boxes;
};
// Some boxes are missing where it was stopped.
MotionBoxes motion_boxes(const BroadPhaseInput& input, Primitive kind, const Stop& stop = {});

// Says whether boxes overlap by a test. This is the definition that all methods keep to.
bool boxes_overlap(BoxTest test, const MotionBox& a, const MotionBox& b);
// Does the same for two primitives, by input.test.
bool boxes_overlap(const BroadPhaseInput& input, PairKind kind, IdPair pair);
// Says whether two primitives pass this and the test of diagonals, where it is used.
bool is_candidate(const BroadPhaseInput& input, PairKind kind, IdPair pair);
// What kernels ask, which know no more of it than a pointer.
struct OverlapDecision {
  const BroadPhaseInput& input;
  PairKind kind;
  static bool meet(const void* context, int a, int b) {
    const OverlapDecision& d = *static_cast<const OverlapDecision*>(context);
    return boxes_overlap(d.input, d.kind, {a, b});
  }
  static bool diagonals_apart(const void* context, int a, int b, unsigned which) {
    const OverlapDecision& d = *static_cast<const OverlapDecision*>(context);
    return onset::diagonals_apart(d.input, d.kind, {a, b}, which);
  }
};

}  // namespace onset
