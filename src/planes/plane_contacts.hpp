// Every vertex against every plane: what limits a step, and the contacts of an active set.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "narrowphase/plane/plane_decision.hpp"
#include "onset/mesh.hpp"
#include "scene/pairs/separation.hpp"
#include "src/shared/budget.hpp"
#include "src/shared/pair_traversal.hpp"

namespace onset {

struct PlaneInput {
  const MeshData& mesh;
  const Motion& motion;
  const Options& options;
  PlaneAsk ask;
};

struct PlaneContacts {
  // With Collect::all, sorted by `before`, the earliest `most`. Where time or the caller ended the call, some
  // of those found until then.
  std::vector<FoundPair> found;
  // With Collect::first and any.
  Limits limits;
  NarrowPhaseStats stats;
};

// Decides every vertex that meets a plane; with Collect::first and any only those that can be the first in
// something. It takes no checks of a budget; a spent one ends it. Nothing is found where there is no plane.
PlaneContacts find_plane_contacts(const PlaneInput& input, Collect collect, Budget& budget,
                                  std::size_t most = std::numeric_limits<std::size_t>::max());

// Decides those listed, which may meet, and returns their limits.
PlaneContacts limits_of_listed(const PlaneInput& input, const std::vector<IdPair>& pairs, Budget& budget);

// Adds the counts of planes to those of a call, after copy_counts.
void add_counts(const PlaneContacts& planes, Stats& stats);

}  // namespace onset
