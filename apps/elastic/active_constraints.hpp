// Contacts as linear inequalities of one iteration of Newton's method: section 7.1 of Wang, Ferguson et al.
// 2021, where contacts are added until a direction has none that is new.
#pragma once

#include <map>
#include <onset/onset.hpp>
#include <tuple>
#include <vector>

#include "simulation/contact.hpp"

namespace elastic {

using namespace simulation;

// Of each pair the multiplier of its latest row, which later programs start from.
using Multipliers = std::map<std::tuple<onset::PairKind, int, int>, double>;

struct ConstrainedDirection {
  Vector dx;                              // of all vertices
  std::vector<onset::Contact> contacts;   // vertices by their ids in the full mesh
  onset::Constraints rows;                // A x >= bound, one a contact
  Vector multipliers;                     // N, one a contact
  int programs = 0;                       // solved
  bool feasible = true, complete = true;  // complete: the last direction had no contact that is new
  double seconds_collision = 0;

  // How far the rows are violated at x, in all.
  double violation(const Vector& x) const;
};

// Minimizes the quadratic model of `system` at x where all pairs that the direction leads closer than eta
// keep it, with the points and normals of their first contact. surface: of the full mesh, whose positions x
// are.
ConstrainedDirection constrained_direction(const System& system, const onset::Mesh& surface, const Vector& x,
                                           double eta, const onset::Options& options, Multipliers& latest);

}  // namespace elastic
