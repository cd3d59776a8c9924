// Contacts as linear inequalities, ready to assemble into a solver's matrix.
#pragma once

#include <onset/active_set.hpp>
#include <onset/export.hpp>
#include <vector>

namespace onset {

// A x >= bound, one row a contact, in the order of the active set, with A as triplets (row, dof, value) and x
// any positions, x y z of vertex 0, x y z of vertex 1, ..., say those at the end of the step.
struct Constraints {
  // Of entry k: 12 entries a contact, those of contact r in [12 r, 12 r + 12). Their columns differ, but for
  // a point (CollisionRules::points), whose three come twice, the second time with value 0, and for a contact
  // with a plane, whose come once for each point, all but the first with value 0. In the plane 6 entries a
  // contact: x y of v, e0 and e1.
  std::vector<int> row;
  // The column: 3 vertex + axis; in the plane 2 vertex + axis.
  std::vector<int> dof;
  // Weight times component of the normal, in [-1, 1].
  std::vector<double> value;
  // eta, one a row; of a contact with a plane eta + offset / |normal|, since p2 is no vertex.
  std::vector<double> bound;
  std::ptrdiff_t rows() const noexcept { return std::ptrdiff_t(bound.size()); }
};

// Makes a linear inequality of each contact: <n, p1 - p2> >= eta, with the normal and the weights at its toi.
//
// Guarantee: none is left out. Contacts that are `degenerate` become rows like all others; where their gap is
// 0 at the start, the side that they ask for is not known (docs/exactness.md), and to leave them out is the
// caller's choice.
//
// eta: model length, finite; Options::min_separation = eta finds the contacts that come closer than it.
// full_vertex: empty, or for each vertex of the mesh its id (>= 0) among all vertices of a simulation, which
// the columns then number (of a volume mesh only the surface collides).
// Throws std::invalid_argument for an eta that is not finite, a plane that the set does not have, or naming
// the vertex where an id is missing, negative or too large for 3 id + 2 to be an int, or where two vertices
// of a contact share one. Safe to call concurrently.
//
// Source: Wang, Ferguson, Schneider, Jiang, Attene, Panozzo, "A Large-Scale Benchmark and an Inclusion-Based
// Algorithm for Continuous Collision Detection", ACM Transactions on Graphics 40(5), 2021, section 7.1.
//
// Example:
//   const onset::ActiveSet set = onset::construct_active_set(mesh, x_t0, x_t1);
//   const onset::Constraints c = onset::assemble_constraints(set);
//   std::vector<Eigen::Triplet<double>> entries;
//   for (std::size_t k = 0; k < c.value.size(); ++k) entries.emplace_back(c.row[k], c.dof[k], c.value[k]);
//   Eigen::SparseMatrix<double> A(c.rows(), 3 * mesh.num_vertices());
//   A.setFromTriplets(entries.begin(), entries.end());  // A x >= c.bound
ONSET_API Constraints assemble_constraints(const ActiveSet& set, double eta = 0,
                                           const std::vector<int>& full_vertex = {});

}  // namespace onset
