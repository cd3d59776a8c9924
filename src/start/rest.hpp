// What every call on positions at rest sets up: a motion that stays, and a broad phase.
#pragma once

#include <memory>
#include <vector>

#include "broadphase/broad_phase.hpp"
#include "onset/mesh.hpp"
#include "src/shared/budget.hpp"

namespace onset {

// Positions at rest, and the pairs whose boxes meet there.
struct Rest {
  Motion motion;
  // Null before `find`, and where positions are not usable (motion.status) or no budget is left.
  std::unique_ptr<BroadPhase> broad;

  Rest(const Mesh& mesh, const Positions& x) : motion(make_motion(mesh.data(), x, x)) {}
  Rest(const Rest&) = delete;
  Rest& operator=(const Rest&) = delete;
  ~Rest();

  // Pairs of a step within Options::min_separation and their thickness, or edges and faces that may meet.
  enum class Pairs { within_separation, edge_face };
  // Makes `broad` for these pairs.
  void find(const Mesh& mesh, Pairs pairs, const Options& options, Budget& budget);

  Outcome outcome(const Budget& budget) const {
    return motion.status != Outcome::free ? motion.status : budget.outcome();
  }
};

}  // namespace onset
