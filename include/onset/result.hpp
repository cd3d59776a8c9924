// What the calls return: outcomes, the limiting pair, contacts, statistics. Plain data.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <onset/export.hpp>
#include <onset/filter_counts.hpp>
#include <vector>

namespace onset {

enum class PairKind : std::uint8_t { vertex_face, edge_edge };

// How a pair, or the whole step, ended. Everything a running solver can produce is one of these, never an
// exception.
enum class Outcome : std::uint8_t {
  free,                // certified (a step or set: of all pairs but those that part from within the separation): farther apart than the separation for the whole step
  contact,             // comes within separation + tolerance at toi > 0; of a line search: or loses its share of a gap
  initial_contact,     // touching, or closer than the separation, at t = 0, and not certified to part: toi 0
  initial_separating,  // the same at t = 0, but the motion parts the pair: toi 0, and a step may go on to
                       // step_limit
  max_checks,          // spent: free until toi, undecided after
  // Of a step: a pair comes, or starts, so close that storing positions in doubles could close its gap. The step ends
  // before that, at 0 where the gap is too small from the start. StepResult::toi says whether the exact motion touches.
  below_rounding,
  non_finite,          // a position is NaN or infinite: step 0, `vertex` names the first
  out_of_range,        // a position is beyond 2^1020 in magnitude: step 0, `vertex` names the first
  // The call ended early (Options: budgets of one call); pairs that were not looked at may touch at any time:
  // step 0 (compute_cfl_stepsize: what the distances allow).
  out_of_time,
  out_of_memory,
  out_of_checks,
  cancelled,  // by Options::progress
};
ONSET_API const char* to_string(Outcome outcome);

// What is known about a contact beyond "not certified free".
enum class Certainty : std::uint8_t {
  within_tolerance,   // undecided: real, or a miss by less than the tolerance
  certain,            // the primitives do touch (come as close as the separation), at the latest at toi_hi
  touching_at_start,  // the same, and already at t = 0
};
ONSET_API const char* to_string(Certainty certainty);

// One pair of primitives. vertex_face: a is the vertex, b the face. edge_edge: a < b are edges.
struct Pair {
  PairKind kind = PairKind::vertex_face;
  int a = -1, b = -1;
  // vertex_face: v, f0, f1, f2; edge_edge: a0, a1, b0, b1, the same twice for a point (Mesh::set_points).
  std::array<int, 4> vertices{-1, -1, -1, -1};
};

struct PairCounts {
  std::int64_t vertex_face = 0, edge_edge = 0;
  std::int64_t total() const { return vertex_face + edge_edge; }
};

// Filled by every call; cheap enough to be always on.
struct Stats {
  PairCounts swept;        // pairs whose swept boxes overlap, where the call counted them (candidates)
  PairCounts candidates;   // pairs handed to the narrow phase
  PairCounts contacts;     // pairs not certified free; of a step: or that storing positions limits
  PairCounts after_culls;  // candidates that the single-precision culls could not separate
  PairCounts inclusion;    // candidates that needed the inclusion root finder
  PairCounts gave_up;      // candidates that spent max_checks
  std::int64_t checks = 0, max_checks_of_a_pair = 0;
  // [k]: candidates left by the culls that took 2^k checks or more, less than 2^(k + 1); the last: 2^15 or
  // more.
  std::array<std::int64_t, 16> checks_histogram{};
  Pair worst;            // the first of those with the most checks (a = -1: none)
  double looked_at = 1;  // share of the pairs looked at, in [0, 1]: < 1 where a budget was spent
  double seconds_broad = 0, seconds_narrow = 0,
         seconds_total = 0;       // broad: motion, boxes and tree; narrow: traversal
                                  // and certificates, which are fused
  double seconds_contacts = 0;    // of an active set: order, contact points and normals
  double tolerance = 0;           // model length: Options::tolerance, or the relative one times `extent`
  double achieved_tolerance = 0;  // the largest distance beyond the separation at which a pair was reported
  double extent = 0;              // R: the largest corner difference that an overlapping pair can have
  std::array<double, 3>
      error_bound{};  // per axis: bound on the rounding error of a corner anywhere in the scene
  FilterCounts filter_counts;         // what the mesh leaves out of every step
  bool made_static_boxes = false;  // boxes of static primitives were made in this call, not taken from an
                                  // earlier one
  int threads = 0;
  const char* instruction_set = "";
  const char* broad_phase = "";
};

struct StepResult {
  // In [0, 1]: x_t0 + s (x_t1 - x_t0) is free of contact for all s in [0, step] along the exact motion, and at
  // s = step, or any s in [shortest, step], also in whatever order of operations it is rounded to doubles.
  double step = 0;
  // 0, unless a pair parts from a gap so small that storing the positions of a shorter step could close it.
  double shortest = 0;
  // The earliest contact of the exact motion: never later, infinite where there is none. With
  // Exactness::exact and separation 0 it is between toi and toi_hi, adjacent doubles or the same one.
  // 0 where the call ended early and nothing is known.
  double toi = 0;
  // Model length: more than storing x_t0 + step (x_t1 - x_t0) in doubles can change a distance (eleven times the bound,
  // docs/steps.md). A pair whose gap at x_t0 is more than twice this never gets a step of 0.
  double rounding = 0;
  Outcome outcome = Outcome::free;
  Pair limiting;    // the pair that limits the step (a = -1 where none does)
  int vertex = -1;  // the offending vertex of non_finite and out_of_range
  // Of the earliest contact of the exact motion, of the limiting pair as a rule; toi_hi: as in ActiveSet, and infinite for the
  // next contact of a pair that parts at the start.
  Certainty certainty = Certainty::within_tolerance;
  double toi_hi = INFINITY;
  Stats stats;
};

// One entry a contact, ordered by (kind, a, b): the same bytes for any number of threads and either kernel.
struct ActiveSet {
  std::vector<PairKind> kind;
  std::vector<int> a, b;
  std::vector<std::array<int, 4>> vertices;
  std::vector<double> toi;  // certified: the pair is apart on [0, toi); never later than the exact time
  std::vector<double>
      step_limit;  // how far the pair lets a step go: toi; initial_separating: the next contact, infinite if none
  std::vector<Outcome> status;  // contact, initial_contact, initial_separating or budget
  std::vector<Certainty> certainty;
  // Finite only where certain: the pair has touched by then. With a separation it is infinite unless the pair touches
  // at the start: that it comes as close is certain, by when is not told. Exactness::exact, separation 0: the
  // earliest contact has adjacent doubles or one double for toi and toi_hi; which others have depends on the window
  // and the budgets.
  std::vector<double> toi_hi;

  // The pair at its toi, where the closest points p1 (of the first primitive) and p2 (of the second) are.
  // weight: of the four `vertices`, clamped to the primitives, multiples of 2^-52; the first side's sum to 1, the
  // second's to -1: p1 - p2 = sum_k weight[k] x[vertices[k]], a form that is linear in the positions at any time. Where
  // several points are as close, as of parallel edges, any of them.
  std::vector<std::array<double, 4>> weight;
  // Unit, from p2 to p1 as the exact closest points lie, however close: where the first primitive came from. Where the two
  // touch inside both primitives: the normal of the face, or of both edges, on the side that the pair was on just before
  // toi, in exact arithmetic.
  std::vector<std::array<double, 3>> normal;
  // |p1 - p2|, model length (Euclidean, the separation not taken off): within 2^-46 of the pair's size of its distance
  // at toi. The size is the largest corner difference at both ends of the step.
  std::vector<double> gap;
  // normal . (displacement of p1 - p2, these weights, in the whole step), model length; < 0: closing. A contact that
  // grazes has one of about 0; a pair within a separation that parts, no less than rounding below 0.
  std::vector<double> speed;
  // 0: the normal is the only one: the gap resolves it, or the pair touches inside both primitives. 1: several would do,
  // as gap is below 2^-46 of the pair's size and a point at the boundary of its primitive (or the edges are parallel, or
  // the face has no area); or the side is not known, as the pair touches at t = 0 or is coplanar at all times. The normal
  // is finite and unit all the same, and where the motion tells, speed has the sign that it should have.
  std::vector<std::uint8_t> degenerate;

  Outcome outcome = Outcome::free;  // contact where there is any entry; non_finite, out_of_range: the set is
                                    // empty; where a budget was spent, that
  int vertex = -1;
  // Every contact with toi < complete_until is in the set. Infinite where all are; earliest + Options::window
  // with a window; 0 where time or checks ran out or the call was cancelled.
  double complete_until = 0;
  Stats stats;

  std::size_t size() const { return kind.size(); }
  ONSET_API std::ptrdiff_t earliest() const;  // index of the smallest (toi, position), -1 when empty
  Pair pair(std::size_t i) const { return {kind[i], a[i], b[i], vertices[i]}; }
};

// One pair on its own.
struct QueryResult {
  Outcome outcome = Outcome::free;
  double toi = INFINITY;         // in [0, 1]; infinite when free
  double step_limit = INFINITY;  // how far the pair lets a step go: toi; initial_separating: the next contact, infinite if none
  double tolerance = 0;  // distance beyond the separation at which the pair was reported
  // As in ActiveSet. Exactness::exact, separation 0: toi and toi_hi are adjacent doubles or the same one.
  Certainty certainty = Certainty::within_tolerance;
  double toi_hi = INFINITY;
  std::int64_t checks = 0;
  bool collides() const { return outcome != Outcome::free; }
};

// The pairs whose swept boxes (of the motion, widened by half the separation each, and by half of what storing positions in
// doubles can change) overlap and share no vertex.
struct Candidates {
  std::vector<std::array<int, 2>> vertex_face, edge_edge;  // sorted; empty when only counts were asked for
  PairCounts counts;
  Outcome outcome = Outcome::free;
  int vertex = -1;
  Stats stats;
};

}  // namespace onset
