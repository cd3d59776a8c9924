// Whether a mesh intersects itself where it stands: edges against faces, decided exactly.
#pragma once

#include <array>
#include <cstddef>
#include <onset/export.hpp>
#include <onset/mesh.hpp>
#include <onset/options.hpp>
#include <onset/result.hpp>
#include <vector>

namespace onset {

// Every call on a step assumes that its start is free of intersections: primitives that have passed through
// each other are apart on the wrong side, and nothing in the positions of that pair tells. These calls look
// at edges against faces, where it does show.

struct Intersections {
  // Ordered by (edge, face): the same bytes for any number of threads, instruction set and broad phase.
  std::vector<Intersection> pairs;
  // {vertex, row of CollisionRules::planes} of those on the plane or behind it, ordered by both. They end as
  // `pairs` do, at 8 bytes each.
  std::vector<std::array<int, 2>> behind_planes;
  // free: all pairs are listed. non_finite, out_of_range, out_of_memory (more than Options::memory_limit
  // holds, at 32 bytes each): none is. out_of_time, cancelled: those found until then, at most 2^16 of more.
  Outcome outcome = Outcome::free;
  // The offending vertex of non_finite and out_of_range, else -1.
  int vertex = -1;
  double seconds = 0;

  std::size_t size() const noexcept { return pairs.size(); }
  // Says that there is neither of both.
  bool empty() const noexcept { return pairs.empty() && behind_planes.empty(); }
  // `pairs` alone.
  auto begin() const noexcept { return pairs.begin(); }
  auto end() const noexcept { return pairs.end(); }
  // How many of them are of one kind.
  ONSET_API std::size_t count(IntersectionKind kind) const noexcept;
};

// Finds every edge and face that have a common point, without sharing a vertex, and every vertex on a plane
// or behind it.
//
// Guarantee: exactly these, for the stored doubles, without a tolerance and at any scale. What the rules of
// the mesh leave out is left out here: static against static too, which no step can mend; with
// CollisionRules::weld vertices at one place count as one. Points (CollisionRules::points) are edges of
// length zero; other vertices are looked at only with their edges. check() looks at vertices against faces
// too, where a face that is folded flat onto its neighbour shows.
//
// x: #V x 3, model length.
// options: only time_limit, memory_limit, progress, threads, broad_phase and instruction_set are used.
// Throws std::invalid_argument for a wrong number of rows or columns, or options out of range.
// Safe to call concurrently on one Mesh.
//
// Source: docs/theory.md, section 19, "Edge and face".
ONSET_API Intersections intersections(const Mesh& mesh, const Positions& x, const Options& options = {});

// Tells whether there is any intersection, touching included, and ends at the first.
//
// Guarantee: false only where there is certainly none. Also true where that is not known: positions that are
// not finite or out of range, a time limit spent or a call cancelled before one was found.
//
// Parameters, errors, thread safety, source: as intersections.
ONSET_API bool has_intersections(const Mesh& mesh, const Positions& x, const Options& options = {});

}  // namespace onset
