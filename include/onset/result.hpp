// What calls say about pairs and about themselves: outcomes, contacts, statistics. Plain data.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <onset/export.hpp>
#include <onset/filter_counts.hpp>
#include <optional>

namespace onset {

// In this order wherever pairs are put in order. vertex_edge: of a mesh in the plane (Mesh::dimension() of
// 2), which has no vertex_face and edge_edge.
enum class PairKind : std::uint8_t { vertex_face, edge_edge, vertex_edge, vertex_plane };
ONSET_API const char* to_string(PairKind kind) noexcept;

// One pair of primitives.
struct Pair {
  PairKind kind = PairKind::vertex_face;
  // vertex_face, vertex_edge: a is the vertex, b the face or edge. edge_edge: edges, a < b. vertex_plane: a
  // is the vertex, b the row of CollisionRules::planes.
  int a = -1, b = -1;
  // vertex_face: v, f0, f1, f2. edge_edge: a0, a1, b0, b1; a point (CollisionRules::points) has the same
  // twice. vertex_edge: v, e0, e1, e1. vertex_plane: v, -1, -1, -1.
  std::array<int, 4> vertices{-1, -1, -1, -1};
};

struct PairCounts {
  std::int64_t vertex_face = 0, edge_edge = 0, vertex_edge = 0, vertex_plane = 0;
  std::int64_t total() const noexcept { return vertex_face + edge_edge + vertex_edge + vertex_plane; }
};

// How one pair ended.
enum class PairOutcome : std::uint8_t {
  // Certified: farther apart than the separation for the whole step.
  free,
  // Comes within separation + tolerance at toi > 0.
  contact,
  // Touches, or is closer than the separation, at t = 0, and is not certified to part: toi 0.
  initial_contact,
  // The same at t = 0, but the motion parts the pair: toi 0, and a step may go on to step_limit.
  initial_separating,
  // Options::max_checks spent: free until toi, undecided after.
  max_checks,
  // Of a step that is stored: comes so close that rounding could close its gap.
  below_rounding,
  // Of a single query: a position is NaN or infinite; or beyond 2^1020 in magnitude.
  non_finite,
  out_of_range,
};
ONSET_API const char* to_string(PairOutcome outcome) noexcept;

// How a call ended. Everything a running solver can produce is one of these, never an exception.
enum class Outcome : std::uint8_t {
  // No pair has a contact, nor limits the step; pairs that part from within the separation may be there.
  free,
  // A pair comes into contact; of a line search: or loses its share of a gap. Not with a step of 0
  // (below_rounding then).
  contact,
  // A pair touches, or is closer than the separation, at t = 0, and is not certified to part: step 0.
  initial_contact,
  // The pair that limits the step spent Options::max_checks: free until then, undecided after. Not with
  // a step of 0 (below_rounding then).
  max_checks,
  // A pair comes, or starts, so close that storing positions in doubles could close its gap. The step ends
  // before that, at 0 where the gap is too small from the start. StepResult::toi says whether the exact
  // motion touches.
  below_rounding,
  // A position is NaN or infinite, or beyond 2^1020 in magnitude: step 0, `vertex` names the first.
  non_finite,
  out_of_range,
  // The call ended early (Options: budgets of one call, progress). Pairs that were not looked at may touch at
  // any time: step 0 (compute_cfl_stepsize: what the distances allow).
  out_of_time,
  out_of_memory,
  out_of_checks,
  cancelled,
};
ONSET_API const char* to_string(Outcome outcome) noexcept;

// What is known about a contact beyond "not certified free".
enum class Certainty : std::uint8_t {
  // Undecided: real, or a miss by less than the tolerance.
  within_tolerance,
  // The primitives do touch (come as close as the separation), at the latest at toi_hi.
  certain,
  // The same, and already at t = 0.
  touching_at_start,
};
ONSET_API const char* to_string(Certainty certainty) noexcept;

// A pair that is not certified free on a step, where and how it touches. Times are in [0, 1], in units of the
// step; lengths in model length.
//
// Of a vertex and a plane all is decided exactly, with a separation too: toi and toi_hi are adjacent doubles
// or one double at every level of Options::exactness, outcome and certainty are as exact arithmetic has them,
// tolerance is 0. The plane is a closed half-space: a vertex on it or behind it touches, with gap 0.
struct Contact : Pair {
  // Certified: the pair is apart on [0, toi). Never later than the exact time. Infinite where it is free.
  double toi = INFINITY;
  // By then the pair has touched (come as close as the separation): finite only where that is certain. 0
  // where it has at the start (touching_at_start), also where the motion parts it. With a separation it is
  // otherwise infinite: that the pair comes as close may be certain, by when is not told. Exactness::exact,
  // separation 0: toi and toi_hi of the earliest contact are adjacent doubles or one double; which others are
  // depends on the window and the budgets.
  double toi_hi = INFINITY;
  // How far the pair lets a step go: toi; of initial_separating the next time at which it comes as close as
  // it was at the start, or touches, infinite where there is none: a pair that starts within its separation
  // may part and come back within it, no closer than it was (docs/steps.md).
  double step_limit = INFINITY;
  // Distance beyond the separation at which the pair was reported; 0, or nearly, where the time is exact.
  double tolerance = 0;
  PairOutcome outcome = PairOutcome::free;
  Certainty certainty = Certainty::within_tolerance;

  // Whether `normal` is one of several, or its side is not known. False: it is the only one, as the gap
  // resolves it or the pair touches inside both primitives. True: gap is below 2^-46 of the pair's size and a
  // point at the boundary of its primitive (or the edges are parallel, or the face has no area); or the pair
  // touches at t = 0 or is coplanar at all times. The normal is finite and unit all the same, and where the
  // motion tells, speed has the sign it should.
  bool degenerate = false;

  // The closest points at toi, p1 of the first primitive and p2 of the second, as weights of the four
  // `vertices`: p1 - p2 = sum_k weights[k] x[vertices[k]], linear in the positions at any time. Clamped to
  // the primitives, multiples of 2^-52; the first side's sum to 1, the second's to -1. Where several points
  // are as close, as of parallel edges, any of them. vertex_edge: 1, e0's, e1's, 0. vertex_plane: 1, 0, 0, 0,
  // and p2 is the point of the half-space that is closest to p1.
  std::array<double, 4> weights{};
  // Unit, from p2 to p1 as the exact closest points lie, however close: where the first primitive came from.
  // Where the two touch inside both primitives: the normal of the face, or of both edges, on the side that
  // the pair was on just before toi, in exact arithmetic. vertex_edge: in the plane, the third component 0.
  std::array<double, 3> normal{};
  // |p1 - p2| (Euclidean, the separation not taken off): within 2^-46 of the pair's size of its distance at
  // toi. The size is the largest corner difference at both ends of the step.
  double gap = 0;
  // normal . (displacement of p1 - p2, these weights, in the whole step); < 0: closing. A contact that grazes
  // has one of about 0; a pair within a separation that parts, no less than rounding below 0.
  double speed = 0;
};

// What a closed edge and a closed face have in common, or in the plane two closed edges: `face` then stands
// for the second edge, the one with the larger id.
enum class IntersectionKind : std::uint8_t {
  // One point, inside the edge and inside the face (or the other edge): the edge goes through.
  crossing,
  // One point, which is an end of the edge or on the boundary of the face, or both.
  touching,
  // A segment: the edge lies in the plane of the face, or along a face without area, or along the other edge.
  overlapping,
};
ONSET_API const char* to_string(IntersectionKind kind) noexcept;

struct Intersection {
  int edge = -1, face = -1;
  IntersectionKind kind = IntersectionKind::crossing;
  // e0, e1, f0, f1, f2; a point (CollisionRules::points) has the same e0 and e1. In the plane e0, e1 and the
  // other edge's f0, f1, f1.
  std::array<int, 5> vertices{-1, -1, -1, -1, -1};
};

// What a call did. Filled by every call; cheap enough to be always on.
struct Stats {
  // Pairs whose swept boxes overlap, where the call counted them (candidates).
  PairCounts swept;
  // Pairs handed to the narrow phase; of these, left by the single-precision culls; that needed the inclusion
  // root finder; that spent Options::max_checks; not certified free (of a step: or that storing positions
  // limits). Of a step, and with a window, boxes end at a time that the first pairs give, so that counts, not
  // answers, depend on the order that a mesh keeps from earlier calls.
  PairCounts candidates, after_culls, inclusion, gave_up, contacts;
  std::int64_t checks = 0, max_checks_of_a_pair = 0;
  // [k]: candidates left by the culls that took 2^k checks or more, less than 2^(k + 1); the last: 2^15 or
  // more.
  std::array<std::int64_t, 16> checks_histogram{};
  // The first of the pairs with the most checks.
  std::optional<Pair> worst;
  // Share of the pairs looked at, in [0, 1]: 1 unless a budget was spent, and even then where the call ended
  // after the last pair.
  double looked_at = 1;
  // Motion, boxes and tree; traversal and certificates, which are fused; order, contact points and normals of
  // an active set; all.
  double seconds_broad = 0, seconds_narrow = 0, seconds_contacts = 0, seconds_total = 0;
  // Model length: Options::tolerance, or the relative one times `extent`; the largest distance beyond the
  // separation at which a pair was reported.
  double tolerance = 0, achieved_tolerance = 0;
  // R: the largest corner difference that an overlapping pair can have.
  double extent = 0;
  // Per axis: bound on the rounding error of a corner anywhere in the scene.
  std::array<double, 3> error_bound{};
  // What the rules of the mesh leave out of every step.
  FilterCounts filter_counts;
  // Whether boxes of static primitives were made in this call, not taken from an earlier one.
  bool made_static_boxes = false;
  int threads = 0;
  const char* instruction_set = "";
  // bvh, hash or brute; held: candidates of an earlier call, tested again (Options::hold_candidates); listed.
  const char* broad_phase = "";
};

}  // namespace onset
