// Rules that single out pairs in random scenes: what each pair has to keep, checked against exact distances.
#pragma once

#include <string>

#include "tests/scenes/random.hpp"
#include "tests/steps/support/scene_truth.hpp"

namespace onset::tests {

// Sets bodies with separations of their own, a shape at rest and rings, each or none, and a separation that
// they have to do with. `rules` may have points already.
void add_pair_rules(const StepScene& scene, scenes::Random& random, Options& options, CollisionRules& rules);

// Returns Asked::keeps, as the library has it. `wrong`: empty, or the first pair that keeps another distance
// than the documentation of CollisionRules says, by exact arithmetic.
std::function<double(PairKind, const std::array<int, 4>&)> separations_of(const Mesh& mesh,
                                                                          const Options& options,
                                                                          std::string& wrong);

// Returns Asked::lets, by excluded_rings alone.
std::function<bool(PairKind, int, int, const std::array<int, 4>&)> beyond_rings(const Mesh& mesh);

}  // namespace onset::tests
