// Sorted uniform grid: for scenes of even size.
#pragma once

#include "broadphase/broad_phase.hpp"

namespace onset {

std::unique_ptr<BroadPhase> make_spatial_hash(const BroadPhaseInput& input);

}  // namespace onset
