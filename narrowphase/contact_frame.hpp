// Where and how a pair touches at one time: contact points as weights of its vertices, normal, gap, speed.
#pragma once

#include <array>
#include <cstddef>

#include "base/motion.hpp"
#include "onset/options.hpp"

namespace onset {

struct ContactFrame {
  // Of the pair's four vertices: the closest points, the first side's sum to 1, the second's to -1, so that
  // p1 - p2 = sum of weight * position. Clamped to the primitives.
  std::array<double, 4> weight{};
  // Unit, from p2 to p1, in the caller's axes. The cross product of the face's edges, or of the two edges,
  // where that is resolved and the closest points are inside both primitives; else the direction of p1 - p2;
  // else, touching, where the pair came from, square to the longest edge if it did not come along it.
  std::array<double, 3> normal{};
  double gap = 0;    // |p1 - p2|, model length
  double speed = 0;  // normal . (motion of p1 - p2 over the whole step), model length; < 0: closing
  bool degenerate =
      false;  // other normals would do as well: at a boundary, or the cross product is not resolved
};

// At time t in [0, 1]. `parting`: the pair is in contact at t = 0 and the motion parts it (its past then lies
// on the side that it moves to). The weights give p1 - p2 within about 20u rho of the shortest difference,
// rho the pair's largest corner difference.
ContactFrame contact_frame(PairKind kind, const Motion& motion, const std::array<int, 4>& vertices, double t,
                           bool parting);

// The same for `count` pairs of one kind, ordinary ones in lanes: frames[i] of vertices[i] at t[i].
// `parting[i]`: as above.
void contact_frames(Kernel kernel, PairKind kind, const Motion& motion, const std::array<int, 4>* vertices,
                    const double* t, const bool* parting, std::size_t count, ContactFrame* frames);

}  // namespace onset
