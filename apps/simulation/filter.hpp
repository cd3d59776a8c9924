// What keeps each step of Newton's method free of contact: a line search for all vertices, a step for each of
// them, or a program of others; and the search for one that does not raise the energy.
#pragma once

#include <memory>
#include <onset/close_pairs.hpp>
#include <onset/line_search.hpp>
#include <optional>
#include <string>
#include <vector>

#include "simulation/collision_server.hpp"
#include "simulation/system.hpp"
#include "simulation/timer.hpp"

namespace simulation {

struct FilterSettings {
  onset::Options options;
  double gap_share = 0.2;   // that every pair keeps of its gap
  bool per_vertex = false;  // onset::truncate_step in the place of onset::LineSearch
  std::string server;       // a command (collision_server.hpp) in the place of both; empty: none
};

// A step along a direction, and what is near where it ends.
struct Trial {
  double step = 0;          // of the direction
  std::vector<double> cut;  // positions of the mesh's vertices, where each goes as far as it may; else empty
  onset::ClosePairs close;
};

struct Search : Trial {
  double limit = 1;              // that was allowed; of a step for each vertex: the share of all motion kept
  bool contact = false;          // whether a pair limited it
  std::string pair;              // that limits it to 0, in words
  double seconds_collision = 0;  // in the library, or in the server in its place, and for near pairs
  double seconds_server = 0;     // those of the server
};

class Filter {
 public:
  // The mesh must outlive it. Throws std::invalid_argument for a server where the mesh has planes.
  Filter(const onset::Mesh& mesh, const Vector& rest, const FilterSettings& settings);

  const onset::Options& options() const { return settings_.options; }
  // The pairs within d_hat at the mesh's positions x.
  onset::ClosePairs close_pairs(const Vector& x, double d_hat) const;

 private:
  friend class FilteredDirection;
  const onset::Mesh* mesh_;
  FilterSettings settings_;
  std::shared_ptr<CollisionServer> server_;
};

// The direction dx at the positions x of the mesh, which are free of intersections, and so will those of each
// trial be. Both must outlive it.
class FilteredDirection {
 public:
  // Throws std::runtime_error where the filter ends with an outcome that is no step.
  FilteredDirection(const Filter& filter, const Vector& x, const Vector& dx, double d_hat);
  Search first() const { return first_; }
  void shorten(Search& trial) const;  // to half of its step

 private:
  void ask_server();
  void ask_library();
  void cut(Search& trial) const;

  const Filter& filter_;
  const Vector &x_, &dx_;
  double d_hat_;
  onset::LineSearch search_;
  Search first_;
};

// The longest of the allowed step, half of it, a quarter, ... that `rises`, which is given a Trial, does not
// refuse; a step of 0 where it refuses all that are to speak of.
template <class Rises>
Search search(const Filter& filter, const Vector& x, const Vector& dx, double d_hat, const Rises& rises) {
  constexpr double kShortest = 1e-6;  // share of a step at which backtracking gives up
  const FilteredDirection direction(filter, x, dx, d_hat);
  Search found = direction.first();
  while (rises(found)) {
    if (!(found.step > 2 * kShortest * direction.first().step)) {
      found.step = 0;
      return found;
    }
    direction.shorten(found);
  }
  return found;
}

}  // namespace simulation
