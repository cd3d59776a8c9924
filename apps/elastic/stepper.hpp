// Implicit Euler by Newton's method, every step of it filtered by the library. Contacts are kept off by
// constraints (sequential quadratic programming) or by a barrier.
#pragma once

#include <onset/onset.hpp>
#include <optional>

#include "elastic/active_constraints.hpp"
#include "elastic/scenes.hpp"
#include "simulation/contact.hpp"
#include "simulation/program/program.hpp"

namespace elastic {

enum class ContactMethod { active_set, barrier };

struct Settings {
  ContactMethod contact = ContactMethod::barrier;
  double time_step = 0.01;  // s
  double friction = 0.3;
  double separation = 1e-3;  // m: eta of the constraints; the barrier reaches as far as twice that
  int iterations = 40;       // of Newton's method a step, at most
  Material material;
  FilterSettings filter;
};

class Stepper final : public Simulation {
 public:
  // Throws std::invalid_argument for a start that intersects itself.
  Stepper(Scene scene, const Settings& settings, const std::optional<State>& start = {});

  StepReport step() override;
  const State& state() const override { return state_; }
  double time_step() const override { return settings_.time_step; }
  const Cells& cells() const override { return cells_; }
  // By full ids.
  const std::vector<std::array<int, 3>>& faces() const override { return faces_; }
  const std::vector<onset::Plane>& planes() const override { return scene_.planes; }

 private:
  struct Goal;
  bool iterate(Goal& goal, const Vector& moved, bool descend, StepReport& report);
  System system(const Goal& goal, const Vector& moved) const;
  double energy(const Goal& goal, const Vector& x, const onset::ClosePairs& close) const;
  ConstrainedDirection direction(Goal& goal, const Vector& moved, StepReport& report) const;
  Vector left_to_move(double time) const;
  onset::ClosePairs close_pairs(onset::ClosePairs of_surface) const;
  void finish(const Vector& before, StepReport& report);
  Vector on_surface(const Vector& x) const;
  bool has_barrier() const { return settings_.contact == ContactMethod::barrier; }

  Scene scene_;
  Settings settings_;
  Bodies bodies_;
  Cells cells_;
  onset::Mesh surface_;
  Filter filter_;
  std::vector<std::array<int, 3>> faces_;
  double d_hat_;
  Barrier barrier_;
  State state_;
  onset::ClosePairs close_;  // at the state, by full ids
};

}  // namespace elastic
