// The pairs that limit how far single vertices go, with their planes.
#pragma once

#include "narrowphase/distance/dividing_plane.hpp"
#include "onset/truncate_step.hpp"
#include "scene/motion/motion.hpp"
#include "scene/pair_source.hpp"
#include "scene/pairs/rest_limits.hpp"
#include "src/shared/visit_pairs.hpp"

namespace onset {

struct MotionLimit {
  Pair pair;
  // Whether the pair touches at the start. Without a plane its vertices stay.
  bool touches, has_plane;
  // Of a vertex and a plane of the mesh alone: whether it starts within its separation.
  bool starts_within;
  DividingPlane plane;
};

// rest: null where the mesh has no shape at rest. Sorted by (kind, a, b); none where the budget is spent, or
// memory_limit.
Gathered<MotionLimit> find_limits(const Mesh& mesh, const Motion& motion, const PairSource& candidates,
                                  const TruncateOptions& options, const RestLimits* rest, Budget& budget);

}  // namespace onset
