// What `onset bench` prints.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "onset/bench/kernel_bench.hpp"
#include "onset/bench/loop_bench.hpp"
#include "onset/bench/scene_bench.hpp"
#include "onset/results/outputs.hpp"

namespace app {

struct NamedCost {
  std::string name;
  std::ptrdiff_t vertices, edges, faces;
  SceneCost cost;
  std::optional<LoopCost> loop;
  std::vector<KernelCost> kernels;

  std::ptrdiff_t primitives() const { return vertices + edges + faces; }
};

Json cost_json(const NamedCost& cost);
std::string describe(const NamedCost& cost, int repeats);
// The curve over several sizes: what must not grow with them.
std::string describe_curve(const std::vector<NamedCost>& costs);
void write_csv(Output& csv, const std::vector<NamedCost>& costs);

}  // namespace app
