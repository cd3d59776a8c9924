// Implicit Euler by Newton's method, every step of it filtered by onset::LineSearch.
#pragma once

#include <onset/onset.hpp>

#include "cloth/elastic.hpp"
#include "cloth/scenes.hpp"
#include "simulation/contact.hpp"

namespace cloth {

struct Settings {
  double time_step = 0.01;  // s
  double friction = 0.3;
  int iterations = 40;  // of Newton's method a step, at most
  Material material;
  onset::Options options;
};

struct StepReport {
  double smallest_step = 1;  // that the line search allowed
  double toi = 1;            // the same where a pair limited it
  int iterations = 0;
  bool converged = false;
  double behind = 0;  // m: how far the vertices moved by hand are from where they should be
  std::size_t contacts = 0;
  double closest = 0;  // distance, d-hat without contacts
  double seconds_collision = 0, seconds = 0;
};

class Stepper {
 public:
  Stepper(Scene scene, const Settings& settings);

  StepReport step();
  const Vector& x() const { return x_; }
  const onset::Mesh& mesh() const { return mesh_; }
  double d_hat() const { return d_hat_; }

 private:
  struct Goal;
  bool iterate(const Goal& goal, const Vector& moved, bool descend, StepReport& report);
  double energy(const Goal& goal, const Vector& x, const onset::ClosePairs& close) const;
  Vector direction(const Goal& goal, const Vector& moved) const;
  Vector left_to_move() const;
  Vector left_to_turn() const;
  void turn(const Goal& goal, StepReport& report);

  Scene scene_;
  Settings settings_;
  onset::Mesh mesh_;
  Elastic elastic_;
  double d_hat_;
  Barrier barrier_;
  Vector x_, velocity_;
  onset::ClosePairs close_;             // at x_
  double time_ = 0, turned_until_ = 0;  // s
};

}  // namespace cloth
