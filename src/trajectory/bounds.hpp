// What a trajectory of the caller's own says, looked at before it is used.
#pragma once

#include <cstddef>

#include "onset/result.hpp"
#include "onset/trajectory.hpp"

namespace onset {

// What is wrong, non_finite or out_of_range, and with which vertex; free: nothing.
struct Fault {
  Outcome outcome = Outcome::free;
  int vertex = -1;
};

// Looks at two positions of a vertex and a bound of how far it strays. Throws std::invalid_argument for a
// bound below 0.
Outcome fault_of(int vertex, const double* from, const double* to, double bound);

// Asks for Trajectory::straying. Throws std::invalid_argument for a bound below 0, and returns what is wrong
// with the first one that is not usable.
Fault ask_straying(const Trajectory& trajectory, double t0, double t1, const int* vertices, std::size_t count,
                   double* bounds);

}  // namespace onset
