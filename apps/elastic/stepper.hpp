// Implicit Euler by Newton's method, every step of it filtered by onset::LineSearch. Contacts are kept off by
// constraints (sequential quadratic programming) or by a barrier.
#pragma once

#include <onset/onset.hpp>
#include <optional>

#include "elastic/active_constraints.hpp"
#include "elastic/frames.hpp"
#include "elastic/scenes.hpp"
#include "simulation/contact.hpp"
#include "simulation/search.hpp"

namespace elastic {

enum class ContactMethod { active_set, barrier };

struct Settings {
  ContactMethod contact = ContactMethod::barrier;
  double time_step = 0.01;  // s
  double friction = 0.3;
  double separation = 1e-3;  // m: eta of the constraints; the barrier reaches as far as twice that
  int iterations = 40;       // of Newton's method a step, at most
  Material material;
  onset::Options options;
};

struct StepReport {
  int step = 0;
  double smallest_step = 1;  // that the line search allowed
  double toi = 1;            // the same where a pair limited it
  int iterations = 0;
  bool converged = false;
  double behind = 0;            // m: how far the vertices moved by hand are from where they should be
  std::size_t contacts = 0;     // pairs within twice the separation at the end
  double closest = 0;           // their least distance; twice the separation without any
  std::size_t constraints = 0;  // the most rows of an iteration
  int programs = 0;             // quadratic programs solved
  int softened = 0;             // iterations whose rows contradicted each other
  double energy = 0;            // J, of the elements and of motion, and of weight from z = 0
  double height = 0;            // m, z of the centre of mass of what is free
  double least_volume = 1;      // of an element, as a share of that at rest
  double seconds_assembly = 0, seconds_solve = 0, seconds_collision = 0, seconds = 0;
};

class Stepper {
 public:
  // Throws std::invalid_argument for a start that intersects itself.
  Stepper(Scene scene, const Settings& settings, const std::optional<State>& start = {});

  StepReport step();
  const State& state() const { return state_; }
  const std::vector<std::array<int, 3>>& faces() const { return faces_; }  // of the surface, by full ids
  const Scene& scene() const { return scene_; }

 private:
  struct Goal;
  bool iterate(Goal& goal, const Vector& moved, bool descend, StepReport& report);
  System system(const Goal& goal, const Vector& moved) const;
  double energy(const Goal& goal, const Vector& x, const onset::ClosePairs& close) const;
  ConstrainedDirection direction(Goal& goal, const Vector& moved, StepReport& report) const;
  Vector left_to_move(double time) const;
  onset::ClosePairs close_pairs(onset::ClosePairs of_surface) const;
  void finish(const Vector& before, StepReport& report);
  bool has_barrier() const { return settings_.contact == ContactMethod::barrier; }

  Scene scene_;
  Settings settings_;
  Bodies bodies_;
  onset::Mesh surface_;
  std::vector<std::array<int, 3>> faces_;
  double d_hat_;
  Barrier barrier_;
  State state_;
  onset::ClosePairs close_;  // at the state, by full ids
};

}  // namespace elastic
