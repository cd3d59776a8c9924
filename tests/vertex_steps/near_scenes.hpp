// Small scenes of any size whose primitives start as close as doubles tell apart.
#pragma once

#include <onset/truncate_step.hpp>

#include "tests/scenes/random.hpp"
#include "tests/steps/support/scene_truth.hpp"

namespace onset::tests {

struct NearScene {
  StepScene scene;
  TruncateOptions options;
};
// Sizes of 1e-9 to 1e9, gaps of 1e-14 to 1e-1 of that, motions of 1e-4 to 10 of it: triangles and wires in
// layers that press on each other, some in one plane, or anywhere. A separation in some, sized for the gap,
// any gap share, a d_hat in some.
NearScene near_scene(scenes::Random& random);

}  // namespace onset::tests
