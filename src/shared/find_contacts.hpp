// The contacts of a step: all of them, or what limits it.
#pragma once

#include "src/shared/pair_traversal.hpp"
#include "src/shared/step_setup.hpp"

namespace onset {

// How many contacts Options::memory_limit lets an active set have.
std::size_t most_contacts(const Options& options);

// Every candidate of `setup`, whose boxes it may shrink, or those that can still matter: limiting, or all within a window. Fills the
// counts and times of `stats`.
TraversalResult find_contacts(const Mesh& mesh, StepSetup& setup, const Options& options, Collect collect, Budget& budget, Stats& stats);

}  // namespace onset
