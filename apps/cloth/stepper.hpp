// Implicit Euler by Newton's method, every step of it filtered by the library.
#pragma once

#include <onset/onset.hpp>
#include <optional>

#include "cloth/elastic.hpp"
#include "cloth/scenes.hpp"
#include "simulation/contact.hpp"
#include "simulation/program/program.hpp"

namespace cloth {

struct Settings {
  double time_step = 0.01;  // s
  double friction = 0.3;
  double reach = 0.1;   // of the barrier, of an edge: d-hat
  int iterations = 40;  // of Newton's method a step, at most
  Material material;
  FilterSettings filter;
};

class Stepper final : public Simulation {
 public:
  Stepper(Scene scene, const Settings& settings, const std::optional<State>& start = {});

  StepReport step() override;
  const State& state() const override { return state_; }
  double time_step() const override { return settings_.time_step; }
  const Cells& cells() const override { return cells_; }
  const std::vector<std::array<int, 3>>& faces() const override { return scene_.faces; }
  const std::vector<onset::Plane>& planes() const override { return scene_.planes; }

 private:
  struct Goal;
  bool iterate(const Goal& goal, const Vector& moved, bool descend, StepReport& report);
  double energy(const Goal& goal, const Vector& x, const onset::ClosePairs& close) const;
  Vector direction(const Goal& goal, const Vector& moved, StepReport& report) const;
  Vector left_to_move() const;
  Vector left_to_turn() const;
  void turn(const Goal& goal, StepReport& report);
  void finish(const Vector& before, StepReport& report);
  double time() const { return (state_.step + 1) * settings_.time_step; }  // at the end of this step

  Scene scene_;
  Settings settings_;
  Cells cells_;
  onset::Mesh mesh_;
  Filter filter_;
  Elastic elastic_;
  double d_hat_;
  Barrier barrier_;
  State state_;
  onset::ClosePairs close_;  // at the state
};

}  // namespace cloth
