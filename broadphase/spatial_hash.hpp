// The broad phase by a sorted uniform grid, for scenes whose primitives are of similar size.
#pragma once

#include "broadphase/broad_phase.hpp"

namespace onset {

std::unique_ptr<BroadPhase> make_spatial_hash(const BroadPhaseInput& input, const Stop& stop);

}  // namespace onset
