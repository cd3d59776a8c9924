// What the simulators do besides simulating: frames, lines, a bar, the exact check, a summary.
#pragma once

#include <onset/collision_rules.hpp>
#include <string>
#include <vector>

#include "simulation/program/arguments.hpp"
#include "simulation/program/frames.hpp"
#include "simulation/report.hpp"

namespace simulation {

class Simulation {
 public:
  virtual ~Simulation() = default;
  virtual StepReport step() = 0;
  virtual const State& state() const = 0;
  virtual double time_step() const = 0;  // s
  virtual const Cells& cells() const = 0;
  virtual const std::vector<std::array<int, 3>>& faces() const = 0;  // of the surface
  virtual const std::vector<onset::Plane>& planes() const = 0;
};

// Runs it until `options.steps`, and prints a summary below `title`. The result is an exit status: 1 where a
// frame that was to be checked has intersections. Throws app::InputError naming a file that cannot be
// written.
int run(Simulation& simulation, const RunOptions& options, const std::string& title);

}  // namespace simulation
