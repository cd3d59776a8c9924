// The contacts of a step, all of them or those that limit it.
#pragma once

#include "onset/step_size.hpp"
#include "src/shared/pair_traversal.hpp"
#include "src/shared/step_setup.hpp"

namespace onset {

// Returns how many contacts Options::memory_limit lets an active set have.
std::size_t most_contacts(const Options& options);

// Decides the candidates of `setup` that can matter to what is collected, and fills counts and times of
// `stats`. It may shrink the boxes of `setup`. Without a broad phase there are no candidates. Of a part of a
// scene the earliest contacts of an active set are left to be sharpened. `only`: as in TraversalBounds; with
// Collect::all, planes apart.
TraversalResult find_contacts(const Mesh& mesh, StepSetup& setup, const Options& options, Collect collect,
                              Budget& budget, Stats& stats, const PairPredicate* only = nullptr);

// Returns the time by which one of these pairs has certainly touched, planes apart.
double least_toi_hi(const std::vector<FoundPair>& found);
// Makes the times of those exact that can be the earliest: no other is before `latest`, the least toi_hi of
// the scene.
void sharpen_earliest(const Mesh& mesh, const StepSetup& setup, const Options& options, double latest,
                      std::vector<FoundPair>& found, Budget& budget);

// Returns the step of a motion; with Collect::any it says no more than whether there is a contact.
StepResult step_of_motion(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1,
                          const Options& options, Collect collect, Budget& budget);

}  // namespace onset
