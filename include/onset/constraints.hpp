// Contacts as linear inequalities, ready to assemble into a solver's matrix.
#pragma once

#include <onset/export.hpp>
#include <onset/active_set.hpp>
#include <vector>

namespace onset {

// <n, p1 - p2> >= eta (paper, section 7.1), one row a contact, in the order of the active set: with
// x = (x y z of vertex 0, x y z of vertex 1, ...), sum_k value[k] x[dof[k]] >= bound[r] over the entries k in
// [12 r, 12 r + 12), all of different columns but for a point (CollisionRules::points), whose three come twice, the
// second time with 0. n and the weights are those at the contact's toi; x is any positions, say those at the
// end of the step.
struct Constraints {
  std::vector<int> row;       // 12 entries a contact
  std::vector<int> dof;       // column: 3 vertex + axis
  std::vector<double> value;  // weight * normal component, in [-1, 1]
  std::vector<double> bound;  // eta; one a row
  std::ptrdiff_t rows() const { return std::ptrdiff_t(bound.size()); }
};

// Rows that are `degenerate` in the set become constraints like all others: where their gap is 0 at the start, the side
// that they ask for is not known (docs/exactness.md), and leaving them out is the caller's choice.
//
// eta: model length, finite; min_separation = eta finds the contacts that come closer than it.
// full_vertex: empty, or for each vertex of the mesh its id (>= 0) among all vertices of a simulation, which
// the columns then number (volume meshes: only the surface collides). Throws std::invalid_argument naming the
// vertex where an id is missing, negative, or too large for 3 id + 2 to be an int, or two vertices of a
// contact share one.
ONSET_API Constraints assemble_constraints(const ActiveSet& set, double eta = 0,
                                           const std::vector<int>& full_vertex = {});

}  // namespace onset
