// What a mesh keeps from call to call; shared by all threads that use it.
#pragma once

#include "base/buffer_pool.hpp"

namespace onset {

class StaticMotion;  // scene/motion/static_motion.hpp
struct StaticTrees;  // broadphase/bvh/static_trees.hpp
class BroadPhase;    // broadphase/broad_phase.hpp

// About the static part of a mesh. The trees are those of a box test and an order of axes, which may change back and
// forth while widths are nearly equal: which slot is whose, the room that makes them says.
struct StaticCache {
  SharedCache<StaticMotion> motion;
  SharedCache<StaticTrees, 18> trees;
};

// Broad phases of earlier calls, for a refit.
using BroadPhasePool = BufferPool<BroadPhase, 4>;

}  // namespace onset
