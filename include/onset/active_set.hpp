// What touches on a step, when and where.
#pragma once

#include <cstddef>
#include <onset/export.hpp>
#include <onset/mesh.hpp>
#include <onset/options.hpp>
#include <onset/result.hpp>
#include <vector>

namespace onset {

struct ActiveSet {
  // Ordered by (kind, a, b): the same bytes for any number of threads and any instruction set.
  std::vector<Contact> contacts;
  // contact where there is any; non_finite, out_of_range: the set is empty; where a budget was spent, that.
  Outcome outcome = Outcome::free;
  // The offending vertex of non_finite and out_of_range, else -1.
  int vertex = -1;
  // Every contact with toi < complete_until is in the set. Infinite where all are; earliest + Options::window
  // with a window; 0 where time or checks ran out or the call was cancelled. Of what was found until then, a
  // call that time or the caller ended puts no more in order than a few milliseconds allow.
  double complete_until = 0;
  // Of the mesh: 3, or 2 in the plane.
  int dimension = 3;
  Stats stats;
  // Those of the mesh (CollisionRules::planes), which contacts of kind vertex_plane name by row.
  std::vector<Plane> planes;

  std::size_t size() const noexcept { return contacts.size(); }
  bool empty() const noexcept { return contacts.empty(); }
  auto begin() const noexcept { return contacts.begin(); }
  auto end() const noexcept { return contacts.end(); }
  const Contact& operator[](std::size_t i) const noexcept { return contacts[i]; }
  // The contact with the least (toi, place in the order); null where the set is empty.
  ONSET_API const Contact* earliest() const noexcept;
};

// Finds every pair that is not certified free on the whole step, its time of impact, point and normal.
//
// Guarantee: no pair with a contact is left out (up to complete_until, where a budget or a window cuts off),
// none has a toi later than its exact time, and none is listed that stays beyond separation + tolerance.
//
// x_t0, x_t1: #V x 3, model length, the two ends of a linear motion; x_t0 is assumed to be free of
// intersections.
// options: Options::window asks for the earliest contacts only.
// Throws std::invalid_argument for a wrong number of rows or columns, a static vertex that moves, options out
// of range.
// Safe to call concurrently on one Mesh.
//
// Source: Wang, Ferguson, Schneider, Jiang, Attene, Panozzo, "A Large-Scale Benchmark and an Inclusion-Based
// Algorithm for Continuous Collision Detection", ACM Transactions on Graphics 40(5), 2021, section 7.1 and
// Algorithm 3; docs/theory.md.
ONSET_API ActiveSet construct_active_set(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1,
                                         const Options& options = {});

}  // namespace onset
