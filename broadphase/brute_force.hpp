// The broad phase that asks the definition about every pair: the reference.
#pragma once

#include "broadphase/broad_phase.hpp"

namespace onset {

std::unique_ptr<BroadPhase> make_brute_force(const BroadPhaseInput& input, const Stop& stop);

}  // namespace onset
