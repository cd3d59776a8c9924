// Pairs with a part that turns, in pieces of time: whole scenes first, then halves for what is left of them.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <unordered_set>
#include <vector>

#include "broadphase/broad_phase.hpp"
#include "onset/mesh.hpp"
#include "onset/result.hpp"
#include "src/shared/budget.hpp"
#include "src/shared/pair_list.hpp"
#include "src/shared/pair_traversal.hpp"
#include "src/trajectory/pieces.hpp"
#include "src/trajectory/turning_scene.hpp"

namespace onset {

// What is asked of a trajectory whose ends are usable.
struct TurningQuestion {
  const Mesh& mesh;
  TurningScene& scene;
  const Trajectory& trajectory;
  const std::vector<double>&x0, &x1;  // X(0) and X(1), 3 #V
  const Options& options;
  Collect collect;
  // What happens later is not looked at.
  double until = 1;
};

struct TurningAnswer {
  // With Collect::all every pair, once, at its earliest contact; else at least the one that comes first, or
  // any. Times are those of the whole step; geometry is that of the chords, with Collect::all.
  std::vector<Contact> contacts;
  // free, non_finite or out_of_range, of `vertex`; out_of_memory.
  Outcome outcome = Outcome::free;
  int vertex = -1;
  // Every contact before this is among them.
  double complete_until = INFINITY;
  // Counts and checks of all pieces together.
  TraversalResult counts;
  double tolerance = 0, extent = 0;
  // As rounding_of_distances, of what has a part that turns.
  double rounding = 0;
};

// Decides all pairs of scene.pieces. It ends early where the budget is spent (docs/trajectories.md).
TurningAnswer refine(const TurningQuestion& question, Budget& budget);

}  // namespace onset
