// Whether a mesh intersects itself where it stands: edges against faces, decided exactly.
#pragma once

#include <cstddef>
#include <onset/export.hpp>
#include <onset/mesh.hpp>
#include <onset/options.hpp>
#include <onset/result.hpp>
#include <vector>

namespace onset {

// Every call on a step assumes that its start is free of intersections: a pair that has passed through one
// another before is apart on the wrong side, and nothing in the positions of that pair tells. These calls
// look at edges against faces, where it does show.

// Ordered by (edge, face): the same bytes for any number of threads, kernel and broad phase.
struct Intersections {
  std::vector<Intersection> pairs;
  // free: all pairs are listed. non_finite, out_of_range, out_of_memory (more than Options::memory_limit
  // holds, at 32 bytes each): none is. out_of_time, cancelled: those found until then.
  Outcome outcome = Outcome::free;
  int vertex = -1;  // the offending vertex of non_finite and out_of_range
  double seconds = 0;

  std::size_t size() const { return pairs.size(); }
  bool empty() const { return pairs.empty(); }
  auto begin() const { return pairs.begin(); }
  auto end() const { return pairs.end(); }
  ONSET_API std::size_t count(IntersectionKind kind) const;
};

// Every edge and face with a common point at x (#V x 3), for the stored doubles, without a tolerance and at
// any scale. Pairs that share a vertex are no pairs, and those that the mesh leaves out are left out here
// (Mesh: static against static too, which no step can mend; vertices at one place count as one with
// CollisionRules::weld). Points declared by CollisionRules::points are edges of length zero; other vertices are in the
// list only with their edges. check() looks at vertices against faces too, where a face folded flat onto its
// neighbour shows. Of the options only time_limit, memory_limit, progress, threads, broad_phase and kernel
// matter. Throws std::invalid_argument for a wrong number of rows or options out of range. Safe to call
// concurrently on one Mesh.
ONSET_API Intersections intersections(const Mesh& mesh, const Positions& x, const Options& options = {});

// Whether there is any, touching included; ends at the first. Also true where that is not known: positions
// that are not finite or out of range, a time limit spent or a call cancelled before one was found. False:
// there is certainly none.
ONSET_API bool has_intersections(const Mesh& mesh, const Positions& x, const Options& options = {});

}  // namespace onset
