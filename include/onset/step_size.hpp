// How far can a step go: the calls that give its size.
#pragma once

#include <functional>
#include <onset/candidates.hpp>
#include <onset/export.hpp>
#include <onset/mesh.hpp>
#include <onset/options.hpp>
#include <onset/result.hpp>
#include <optional>

namespace onset {

struct StepResult {
  // In [0, 1]. x_t0 + s (x_t1 - x_t0) is free of contact for all s in [0, step] along the exact motion, and
  // at s = step, or any s in [shortest, step], also as rounded to doubles in any of the orders of operations
  // that docs/steps.md names.
  double step = 0;
  // 0, unless a pair parts from a gap so small that storing the positions of a shorter step could close it.
  double shortest = 0;
  // The earliest contact of the exact motion: never later, infinite where there is none. With
  // Exactness::exact and separation 0 it is between toi and toi_hi, adjacent doubles or the same one. Where
  // the call ended early 0; of compute_cfl_stepsize then the step, or infinite where that is 1.
  double toi = 0;
  // As Contact::toi_hi, of the earliest contact; infinite for the next contact of a pair that parts at the
  // start.
  double toi_hi = INFINITY;
  // Model length: more than storing x_t0 + step (x_t1 - x_t0) in doubles can change a distance
  // (docs/steps.md). A pair whose gap at x_t0 is more than twice this never gets a step of 0.
  double rounding = 0;
  Outcome outcome = Outcome::free;
  // Of the earliest contact of the exact motion, of the limiting pair as a rule.
  Certainty certainty = Certainty::within_tolerance;
  // The pair that limits the step, where one does.
  std::optional<Pair> limiting;
  // The offending vertex of non_finite and out_of_range, else -1.
  int vertex = -1;
  Stats stats;
};

// Computes the largest step from x_t0 towards x_t1 that is certainly free of contact.
//
// Guarantee: no contact on [0, step] along the exact linear motion, nor at the positions that are stored
// (StepResult); step > 0 wherever every pair starts apart by more than twice StepResult::rounding. The same
// bytes for any number of threads and any instruction set.
//
// mesh: topology and rules.
// x_t0, x_t1: #V x 3, model length, the two ends of the motion. x_t0 is assumed to be free of intersections
// (check() in onset/check.hpp tells); a pair that touches there blocks the step.
// options: accuracy, separation, budgets.
// Throws std::invalid_argument for a wrong number of rows or columns, a static vertex that moves, options out
// of range.
// Safe to call concurrently on one Mesh.
//
// Source: Wang, Ferguson, Schneider, Jiang, Attene, Panozzo, "A Large-Scale Benchmark and an Inclusion-Based
// Algorithm for Continuous Collision Detection", ACM Transactions on Graphics 40(5), 2021, section 7.2;
// docs/theory.md.
ONSET_API StepResult compute_collision_free_stepsize(const Mesh& mesh, const Positions& x_t0,
                                                     const Positions& x_t1, const Options& options = {});

// Computes the step of pairs that the caller has chosen: found once, filtered, kept from call to call.
//
// Guarantee: as above, for the pairs listed; others are not looked at. The list must hold every pair that may
// touch, as compute_candidates gives for this motion, or for one that contains it, and the same
// min_separation or more. A pair that comes within the tolerance and never touches may limit this step and
// not that of the call without a list, which does not look at pairs whose boxes are never at one place at one
// time. With a separation it is also the other way round: that call looks as far as separation + tolerance,
// compute_candidates only as far as the separation, so that a pair which stays beyond its separation and
// comes within the tolerance may limit that step and not this one. Both steps are free of contact.
//
// candidates: pairs by id, in any order, those that the rules of the mesh leave out limiting nothing; counts
// and statistics are not used. gap_share: in [0, 1). Every pair keeps this share of its gap at x_t0, as in
// LineSearch. Throws as above, and std::invalid_argument for gap_share out of range, candidates with an
// outcome (they are not complete), or naming the row for an id out of range or a pair that shares a vertex;
// rows that are left when time or the caller ends the call are not checked.
// Safe to call concurrently on one Mesh.
ONSET_API StepResult compute_collision_free_stepsize(const Mesh& mesh, const Candidates& candidates,
                                                     const Positions& x_t0, const Positions& x_t1,
                                                     const Options& options = {}, double gap_share = 0);

// Tells whether the whole exact motion, both ends included, is certified free of contact. Stops at the first
// pair that is not. Pairs that start within the separation and part do not count. False also where that is
// not known: positions that are not usable, a spent budget.
//
// Parameters, errors, thread safety: as compute_collision_free_stepsize.
ONSET_API bool is_step_collision_free(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1,
                                      const Options& options = {});

// Runs `work` on this thread in the default floating-point environment: it rounds to nearest, keeps subnormal
// numbers and traps nothing.
//
// Guarantee: afterwards, and where `work` throws, the thread has the environment and the flags that it had
// before. All calls of the library compute in this environment, whatever the host has set. Hosts that have
// set another one use it for positions: what is promised of stored positions (StepResult) is promised of
// those that are stored in it, and a direction is the same bytes as elsewhere where it is computed in it.
// Threads that `work` hands tasks to keep their own.
// Throws std::bad_function_call where `work` is empty, and what it throws.
// Safe to call concurrently, and from inside `work`.
//
// Example:
//   const double step = onset::compute_collision_free_stepsize(mesh, x_t0, x_t1).step;
//   onset::in_default_float_environment([&] { x = x_t0 + step * (x_t1 - x_t0); });
ONSET_API void in_default_float_environment(const std::function<void()>& work);

}  // namespace onset
