// What calls cost with each instruction set that this machine has.
#pragma once

#include <string>
#include <vector>

#include "files/scene/scene.hpp"
#include "measure/timing.hpp"
#include "onset/results/outputs.hpp"

namespace app {

// CPU seconds of calls made in turns, set after set, and how many times as fast as with the scalar text they
// are, round by round. No pairs are held between calls.
struct KernelCost {
  struct OfCall {
    Spread cpu, times;
  };
  std::string name;
  OfCall active_set, step;
};

// Throws std::runtime_error where two sets give different answers.
std::vector<KernelCost> bench_kernels(const Scene& scene, const onset::Options& options, int rounds);

Json kernels_json(const std::vector<KernelCost>& costs);
std::string describe(const std::vector<KernelCost>& costs);

}  // namespace app
