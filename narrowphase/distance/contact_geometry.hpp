// Where and how a pair touches at one time: contact points as weights of its vertices, normal, gap, speed.
#pragma once

#include <array>
#include <cstddef>

#include "onset/options.hpp"
#include "scene/motion/motion.hpp"

namespace onset {

struct ContactGeometry {
  // p1 - p2 = sum of weight * position over the pair's four vertices. The first side's weights sum to 1, the
  // second's to -1, and both points are in their primitives.
  std::array<double, 4> weights{};
  // Unit, in the caller's axes: the direction of p1 - p2, square to the face or both edges where the points
  // are inside. A pair that touches inside has the same on the side that it came from, exactly; one that
  // touches at a boundary, or nearly, has a direction that separates it, from where it came.
  std::array<double, 3> normal{};
  double gap = 0;  // |p1 - p2|, model length
  // normal . (motion of p1 - p2 over the whole step), model length; below 0 it is closing.
  double speed = 0;
  // Other normals would do as well: the points are at a boundary and within 2^-46 of the pair's size, or
  // nothing tells the side of a touching pair.
  bool degenerate = false;
};

// Computes them at time t in [0, 1], until which the pair is apart; the weights give p1 - p2 within about 20u
// rho, rho the largest corner difference. `parting`: the pair is in contact at t = 0 and parts, so its past
// lies on the side that it moves to.
ContactGeometry contact_geometry(PairKind kind, const Motion& motion, const std::array<int, 4>& vertices, double t,
                           bool parting);

// Computes them for `count` pairs of one kind, ordinary ones in lanes.
void contact_geometries(InstructionSet kernel, PairKind kind, const Motion& motion, const std::array<int, 4>* vertices,
                    const double* t, const bool* parting, std::size_t count, ContactGeometry* out);

}  // namespace onset
