// Small random scenes and options for them.
#pragma once

#include "tests/scenes/random.hpp"
#include "tests/steps/support/scene_truth.hpp"

namespace onset::tests {

// Two to four triangles or wires with small integer coordinates at both ends: contacts at 0, 1/2, 1, ties
// everywhere.
StepScene grid_scene(scenes::Random& random);
// Triangles and wires that fall onto, into or short of a floor of two triangles along an axis, of any size.
StepScene floor_scene(scenes::Random& random);
// One or two pairs of one of the families.
StepScene family_scene(scenes::Random& random);
// Two tetrahedra that run into one another, or past.
StepScene tetrahedra(scenes::Random& random);

// Twenty to forty triangles with small integer or any coordinates, or that many over a floor.
StepScene crowded_scene(scenes::Random& random);

StepScene random_scene(scenes::Random& random);

// Tolerances down to 1e-300, checks from 1, every method, norm and level; a separation in some, sized for the
// scene.
Options random_options(const StepScene& scene, scenes::Random& random);

// Powers of two and zeros for some of the vertices: their sums with a separation that is one are exact.
std::vector<double> random_thickness(const StepScene& scene, scenes::Random& random);

}  // namespace onset::tests
