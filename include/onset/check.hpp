// Whether positions will do as the start of a step, what is in the way, and the call that cures it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <onset/close_pairs.hpp>
#include <onset/export.hpp>
#include <onset/intersections.hpp>
#include <onset/mesh.hpp>
#include <onset/options.hpp>
#include <onset/result.hpp>
#include <string>
#include <vector>

namespace onset {

enum class StartFault : std::uint8_t {
  intersecting,        // edges and faces with a common point
  touching,            // vertex-face and edge-edge pairs with a common point
  within_separation,   // pairs that do not touch, and are no farther apart than they have to keep
  copied_vertices,     // vertices at the place of another
  faces_without_area,  // corners on one line, or two at one place
  unused_vertices,     // of no edge and no face, nor declared as points
};
ONSET_API const char* to_string(StartFault fault);

// One kind of fault in words: how many, the first by its ids, and the call that cures it.
struct StartFinding {
  StartFault fault = StartFault::intersecting;
  std::size_t count = 0;
  std::string text;
};

// All lists are in order, and the same bytes for any number of threads, kernel and broad phase. Pairs are
// those that the mesh lets meet: what is left out of every call is named in none.
struct StartReport {
  std::vector<Intersection> intersections;  // as intersections() lists them: CollisionRules::excluded_intersections
  std::vector<Pair> touching;               // distance exactly 0, by (kind, a, b): CollisionRules::excluded_pairs
  // 0 < distance <= separation (min_separation + thickness, in the norm asked for), or beyond that by no more
  // than rounding, by (kind, a, b).
  std::vector<ClosePair> within_separation;
  // {first vertex at a place, another one there}, by both; not what CollisionRules::weld or excluded_vertices
  // joins, what never meets (static, in one rigid body, in excluded bodies), nor unused vertices.
  // duplicate_vertices() gives what CollisionRules::excluded_vertices takes.
  std::vector<std::array<int, 2>> copied_vertices;
  std::vector<int> faces_without_area;
  std::vector<int> unused_vertices;

  std::vector<StartFinding> findings;  // one for each list that is not empty, in the order of StartFault

  // free: the lists are complete. non_finite, out_of_range: only unused_vertices is. Budgets: lists of pairs
  // are what was found until then (out_of_memory: empty), the others complete.
  Outcome outcome = Outcome::free;
  int vertex = -1;  // the offending vertex of non_finite and out_of_range
  double seconds = 0;

  // Whether a step may start here: known to have no intersecting or touching pair and none within the
  // separation.
  bool acceptable() const {
    return outcome == Outcome::free && intersections.empty() && touching.empty() && within_separation.empty();
  }
  // Whether nothing at all was found.
  bool clean() const { return outcome == Outcome::free && findings.empty(); }
};

// Looks at x (#V x 3) as the start of a step with these options. Intersections, touching pairs, copies and
// faces without area are decided exactly. Throws std::invalid_argument for a wrong number of rows or options
// out of range. Safe to call concurrently on one Mesh.
ONSET_API StartReport check(const Mesh& mesh, const Positions& x, const Options& options = {});

// Vertices at exactly the same place, as {smaller id, larger id}, by both: for CollisionRules::excluded_vertices,
// after which all copies at one place count as one vertex. k copies are k (k - 1) / 2 pairs; CollisionRules::weld
// needs no list. Throws std::invalid_argument for other than 3 columns, or naming the first row that is not
// finite. O(#V log #V + pairs).
ONSET_API std::vector<std::array<int, 2>> duplicate_vertices(const Positions& x);

}  // namespace onset
