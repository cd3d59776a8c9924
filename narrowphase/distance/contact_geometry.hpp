// Where and how a pair touches at one time: contact points as weights of its vertices, normal, gap, speed.
#pragma once

#include <array>
#include <cstddef>

#include "onset/options.hpp"
#include "scene/motion/motion.hpp"

namespace onset {

struct ContactGeometry {
  // p1 - p2 = sum of weight * position. The first side's weights sum to 1, the second's to -1; both points
  // are in their primitives.
  std::array<double, 4> weights{};
  // Unit, in the caller's axes: the direction of p1 - p2, square to the face or both edges where the points
  // are inside. A pair that touches inside has it on the side from which it came, exactly; one that touches
  // at a boundary, or nearly, some direction that leads there.
  std::array<double, 3> normal{};
  double gap = 0;  // |p1 - p2|, model length
  // The motion of p1 - p2 along the normal over the whole step, model length; below 0 it is closing.
  double speed = 0;
  // Other normals would do: the points are within 2^-46 of the pair's size at a boundary, or nothing tells
  // the side of a touching pair.
  bool degenerate = false;
};

// Computes them at time t, until which the pair is apart; the weights give p1 - p2 within about 20u rho, rho
// the largest corner difference. `parting`: the pair is in contact at t = 0, so its past lies on the side
// that it moves to.
ContactGeometry contact_geometry(PairKind kind, const Motion& motion, const std::array<int, 4>& vertices,
                                 double t, bool parting);

// The same for `count` pairs of one kind, ordinary ones in lanes.
void contact_geometries(InstructionSet kernel, PairKind kind, const Motion& motion,
                        const std::array<int, 4>* vertices, const double* t, const bool* parting,
                        std::size_t count, ContactGeometry* out);

}  // namespace onset
