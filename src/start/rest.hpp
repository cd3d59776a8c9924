// What the calls on positions at rest set up: the pairs whose boxes meet where they stand.
#pragma once

#include <memory>
#include <vector>

#include "broadphase/broad_phase.hpp"
#include "onset/mesh.hpp"
#include "src/shared/budget.hpp"

namespace onset {

struct Rest {
  Motion motion;  // that stays
  // Null where the positions are not usable (motion.status), or no budget is left.
  std::unique_ptr<BroadPhase> broad;

  Rest(const Mesh& mesh, const Positions& x) : motion(make_motion(mesh.data(), x, x)) {}
  Rest(const Rest&) = delete;
  Rest& operator=(const Rest&) = delete;
  ~Rest();

  // The pairs of a step that come within Options::min_separation and their thickness, or kEdgeFace with a
  // common point.
  enum class Pairs { within_separation, edge_face };
  void find(const Mesh& mesh, Pairs pairs, const Options& options, Budget& budget);

  Outcome outcome(const Budget& budget) const {
    return motion.status != Outcome::free ? motion.status : budget.outcome();
  }
};

}  // namespace onset
