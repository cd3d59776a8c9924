// The line search of one iteration of Newton's method: a step that is free of contact and, where the caller
// descends, one that does not raise the energy.
#pragma once

#include <algorithm>
#include <onset/close_pairs.hpp>
#include <onset/line_search.hpp>

#include "simulation/system.hpp"
#include "simulation/timer.hpp"

namespace simulation {

struct Search {
  double step = 0;               // taken; 0: no step to speak of lowers the energy
  double limit = 1;              // that the line search allowed
  bool contact = false;          // whether a pair limited it
  onset::ClosePairs close;       // at x + step dx
  double seconds_collision = 0;  // in the library
};

// Filters the direction dx at the positions x of the mesh, which are free of intersections, and so will those
// of the step be. `rises` tells of a step and its close pairs whether they are to be refused.
// Throws std::runtime_error where the library ends with an outcome that is no step.
template <class Rises>
Search search(const onset::Mesh& mesh, const onset::Positions& x, const onset::Positions& dx, double d_hat,
              const onset::Options& options, const Rises& rises);

// The same without an energy, and the search that a caller goes on asking.
class FilteredDirection {
 public:
  FilteredDirection(const onset::Mesh& mesh, const onset::Positions& x, const onset::Positions& dx,
                    double d_hat, const onset::Options& options);
  Search first() const { return first_; }
  onset::ClosePairs close_pairs(double step) const { return search_.close_pairs(step); }

 private:
  onset::LineSearch search_;
  Search first_;
};

template <class Rises>
Search search(const onset::Mesh& mesh, const onset::Positions& x, const onset::Positions& dx, double d_hat,
              const onset::Options& options, const Rises& rises) {
  constexpr double kShortest = 1e-6;  // share of a step at which backtracking gives up
  const FilteredDirection direction(mesh, x, dx, d_hat, options);
  Search found = direction.first();
  while (rises(found.step, found.close)) {
    found.step /= 2;
    if (!(found.step > kShortest * found.limit)) {
      found.step = 0;
      return found;
    }
    const Timer again;
    found.close = direction.close_pairs(found.step);
    found.seconds_collision += again.seconds();
  }
  return found;
}

}  // namespace simulation
