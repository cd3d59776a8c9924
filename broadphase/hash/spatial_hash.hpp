// The broad phase by cells of grids, each primitive in one cell of the grid that suits its size.
#pragma once

#include "broadphase/broad_phase.hpp"

namespace onset {

std::unique_ptr<BroadPhase> make_spatial_hash(const BroadPhaseInput& input, const Stop& stop);

}  // namespace onset
