// What a mesh keeps from call to call; shared by all threads that use it.
#pragma once

#include "base/buffer_pool.hpp"

namespace onset {

class StaticMotion;   // scene/motion/static_motion.hpp
struct StaticTrees;   // broadphase/bvh/static_trees.hpp
class BroadPhase;     // broadphase/broad_phase.hpp
struct TurningScene;  // src/trajectory/turning_scene.hpp

// What is kept of the static part of a mesh. Trees have a slot for each order of axes, which may change back
// and forth while widths are nearly equal, for swept and for motion boxes; broadphase/bvh/static_trees.cpp
// numbers them.
struct StaticCache {
  SharedCache<StaticMotion> motion;
  SharedCache<StaticTrees, 18> trees;
};

// Broad phases of earlier calls, to be refitted; src/shared/step_setup.cpp numbers the slots.
using BroadPhasePool = BufferPool<BroadPhase, 4>;

// What calls on trajectories make of the mesh.
using TurningScenePool = BufferPool<TurningScene, 1>;

}  // namespace onset
