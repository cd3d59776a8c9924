// The broad phase by a tree whose nodes hold the boxes at both ends of the motion.
#pragma once

#include "broadphase/broad_phase.hpp"

namespace onset {

std::unique_ptr<BroadPhase> make_bvh(const BroadPhaseInput& input, const Stop& stop);

}  // namespace onset
