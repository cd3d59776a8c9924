// Where and how a pair touches at one time: contact points as weights of its vertices, normal, gap, speed.
#pragma once

#include <array>
#include <cstddef>

#include "onset/options.hpp"
#include "scene/motion/motion.hpp"

namespace onset {

struct ContactGeometry {
  // Of the pair's four vertices: the closest points, the first side's sum to 1, the second's to -1, so that
  // p1 - p2 = sum of weight * position. Clamped to the primitives.
  std::array<double, 4> weights{};
  // Unit, in the caller's axes. The direction of p1 - p2, which is square to the face, or to both edges,
  // where the points are inside both primitives; touching inside, the same on the side that the pair came
  // from, exactly. Touching, or as good as that, at a boundary: a direction that does, from where the pair
  // came.
  std::array<double, 3> normal{};
  double gap = 0;    // |p1 - p2|, model length
  double speed = 0;  // normal . (motion of p1 - p2 over the whole step), model length; < 0: closing
  // Other normals would do as well: the points are within 2^-46 of the pair's size of each other and at a
  // boundary, or touching and nothing tells the side.
  bool degenerate = false;
};

// At time t in [0, 1], until which the pair is apart. `parting`: the pair is in contact at t = 0 and the
// motion parts it (its past then lies on the side that it moves to). The weights give p1 - p2 within about
// 20u rho of the shortest difference, rho the pair's largest corner difference.
ContactGeometry contact_geometry(PairKind kind, const Motion& motion, const std::array<int, 4>& vertices, double t,
                           bool parting);

// The same for `count` pairs of one kind, ordinary ones in lanes: frames[i] of vertices[i] at t[i].
// `parting[i]`: as above.
void contact_geometries(InstructionSet kernel, PairKind kind, const Motion& motion, const std::array<int, 4>* vertices,
                    const double* t, const bool* parting, std::size_t count, ContactGeometry* out);

}  // namespace onset
