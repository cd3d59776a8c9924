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
  // Edges and faces with a common point.
  intersecting,
  // Vertex-face and edge-edge pairs with a common point.
  touching,
  // Pairs that do not touch, and are no farther apart than they have to keep.
  within_separation,
  // Vertices at the place of another.
  copied_vertices,
  // Faces with all corners on one line, or two at one place.
  faces_without_area,
  // Vertices of no edge and no face, nor declared as points.
  unused_vertices,
};
ONSET_API const char* to_string(StartFault fault) noexcept;

// One kind of fault.
struct StartFinding {
  StartFault fault = StartFault::intersecting;
  std::size_t count = 0;
  // In words: how many, the first by its ids, and the call that cures them.
  std::string text;
};

// What check() found. All lists are in order, and the same bytes for any number of threads, instruction set
// and broad phase. Pairs are those that the rules of the mesh let meet.
struct StartReport {
  // As intersections() lists them; CollisionRules::excluded_intersections leaves them out.
  std::vector<Intersection> intersections;
  // Pairs at distance exactly 0, vertices on a plane or behind it among them, by (kind, a, b);
  // CollisionRules::excluded_pairs leaves them out. An edge and a face of theirs that touch are in
  // `intersections` until CollisionRules::excluded_intersections has them.
  std::vector<Pair> touching;
  // 0 < distance <= the pair's separation (min_separation + thickness, or what CollisionRules say of it), or
  // beyond that by no more than rounding, by (kind, a, b).
  std::vector<ClosePair> within_separation;
  // {first vertex at a place, another one there}, by both. Not listed are those that CollisionRules::weld or
  // excluded_vertices joins, those that never meet (static, in one rigid body, in excluded bodies), and
  // unused vertices. duplicate_vertices() gives what CollisionRules::excluded_vertices takes.
  std::vector<std::array<int, 2>> copied_vertices;
  std::vector<int> faces_without_area;
  std::vector<int> unused_vertices;

  // One for each list that is not empty, in the order of StartFault.
  std::vector<StartFinding> findings;

  // free: the lists are complete. non_finite, out_of_range: only unused_vertices is. out_of_time, cancelled:
  // they have what was found until then, of pairs at most 2^16 of more. out_of_memory: the three lists of
  // pairs have nothing, the others are complete.
  Outcome outcome = Outcome::free;
  // The offending vertex of non_finite and out_of_range, else -1.
  int vertex = -1;
  double seconds = 0;

  // Whether a step may start here: it is known that no pair intersects, touches or is within its separation.
  bool acceptable() const noexcept {
    return outcome == Outcome::free && intersections.empty() && touching.empty() && within_separation.empty();
  }
  // Whether nothing at all was found.
  bool clean() const noexcept { return outcome == Outcome::free && findings.empty(); }
};

// Lists all that may be wrong with x as the start of a step with these options.
//
// Guarantee: intersections, touching pairs, copies and faces without area are decided exactly, for the stored
// doubles; no pair within its separation is left out.
//
// x: #V x 3, model length.
// options: min_separation and norm decide what is within the separation; memory_limit counts 32 bytes an
// intersection, 96 another pair; check_limit and all about accuracy are not used.
// Throws std::invalid_argument for a wrong number of rows or columns, or options out of range.
// Safe to call concurrently on one Mesh.
//
// Source: docs/theory.md, sections 15 and 19.
//
// Example:
//   const onset::StartReport report = onset::check(mesh, x);
//   for (const onset::StartFinding& finding : report.findings) std::puts(finding.text.c_str());
//   onset::CollisionRules rules = mesh.rules();
//   rules.excluded_pairs = report.touching;  // these may pass through each other from now on
//   rules.excluded_intersections = report.intersections;  // else check still lists their edges and faces
//   mesh.set_rules(rules);
ONSET_API StartReport check(const Mesh& mesh, const Positions& x, const Options& options = {});

// Lists all pairs of vertices at exactly the same place, for CollisionRules::excluded_vertices, after which
// all copies at one place count as one vertex. CollisionRules::weld needs no list.
//
// Guarantee: each pair once, as {smaller id, larger id}, ordered by both; k copies are k (k - 1) / 2 pairs. 0
// and -0 are one place. O(#V log #V + pairs).
//
// x: #V x 3, model length.
// Throws std::invalid_argument for other than 3 columns, or naming the first row that is not finite.
// Safe to call concurrently.
ONSET_API std::vector<std::array<int, 2>> duplicate_vertices(const Positions& x);

}  // namespace onset
