// What one time step was like.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>

#include "simulation/filter.hpp"

namespace simulation {

struct ConstraintReport {
  std::size_t rows = 0;  // the most of an iteration
  int programs = 0;      // quadratic programs solved
  int softened = 0;      // iterations whose rows contradicted each other
};

struct StepReport {
  int step = 0;
  int iterations = 0;
  bool converged = false;
  double toi = 1;                      // the smallest step where a pair limited it
  double smallest_step = 1;            // that the filter allowed
  int stalls = 0;                      // directions of which it allowed nothing
  std::string stalled_by;              // the pair of the first of them
  double behind = 0;                   // m: how far the vertices moved by hand are from where they should be
  std::size_t contacts = 0;            // pairs near each other at the end
  double closest = 0;                  // their least distance; without any, what counts as near
  double energy = 0;                   // J, of what is elastic and of motion, and of weight from z = 0
  double height = 0;                   // m, z of the centre of mass of what is free
  std::optional<double> least_volume;  // of an element, as a share of that at rest
  std::optional<ConstraintReport> constraints;
  // CPU seconds; `seconds`: all of the step. Until it ends, those of a collision server.
  double seconds_assembly = 0, seconds_solve = 0, seconds_collision = 0, seconds = 0;

  void add(const Search& found) {
    smallest_step = std::min(smallest_step, found.limit);
    if (found.contact) toi = std::min(toi, found.limit);
    if (found.limit == 0 && stalls++ == 0) stalled_by = found.pair;
    seconds_collision += found.seconds_collision;
    seconds += found.seconds_server;  // which no timer of this process sees
  }
  void count(const onset::ClosePairs& close, double d_hat) {
    contacts = close.size();
    closest = d_hat;
    for (const onset::ClosePair& p : close) closest = std::min(closest, p.distance);
  }
};

}  // namespace simulation
