// The box of a primitive at both ends of the motion, exact in double, and the test on it that defines a
// candidate.
#pragma once

#include <array>
#include <vector>

#include "broadphase/broad_phase.hpp"
#include "scene/primitive_filter.hpp"

namespace onset {

// Closed boxes of the primitive at t = 0 and at t_max, widened by its inflation (rounded outward; exact
// without one).
struct MotionBox {
  std::array<double, 3> lo_t0, hi_t0, lo_t1, hi_t1;
};

// By how much primitives are widened, thickness apart.
inline double part_inflation(const BroadPhaseInput& input, bool is_static) {
  return is_static && input.static_inflation >= 0 ? input.static_inflation : input.inflation;
}

// Widened by an upper bound on `inflation` + the largest thickness of the primitive's vertices.
MotionBox motion_box(const BroadPhaseInput& input, Primitive kind, int id, double inflation);
MotionBox motion_box(const BroadPhaseInput& input, Primitive kind, int id);

// The primitives that take part, in the order of ids, and their boxes.
struct MotionBoxes {
  std::vector<int> ids;
  std::vector<MotionBox> boxes;
};
MotionBoxes motion_boxes(const BroadPhaseInput& input, Primitive kind);

// The definition of all tests, which every method reduces to. Swept: closed swept boxes overlap. Motion: no
// axis separates strictly, on the same side, at both ends. Passing: nor do the axes take turns.
bool boxes_overlap(BoxTest test, const MotionBox& a, const MotionBox& b);
// Of two primitives, by input.test.
bool boxes_overlap(const BroadPhaseInput& input, PairKind kind, IdPair pair);

}  // namespace onset
