// The candidates of a part of a scene that this part decides.
#pragma once

#include <memory>

#include "broadphase/broad_phase.hpp"

namespace onset {

// Leaves out of what `all` streams the pairs that other parts decide (MeshData::whole of input.mesh).
std::unique_ptr<BroadPhase> pairs_of_part(std::unique_ptr<BroadPhase> all, const BroadPhaseInput& input);

}  // namespace onset
