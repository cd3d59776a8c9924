// A tree that a mesh keeps from call to call, and that holds pairs where positions hardly change between
// them.
#pragma once

#include <memory>

#include "broadphase/broad_phase.hpp"

namespace onset {

// Candidates, their number and blocks are those of make_bvh's tree, whatever earlier calls held. Null where
// it was stopped.
std::unique_ptr<BroadPhase> make_holding_tree(const BroadPhaseInput& input, const Stop& stop);

}  // namespace onset
