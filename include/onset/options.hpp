// What a caller may choose: accuracy, separation, budgets, algorithms, threads.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>

namespace onset {

// The norm of the minimum separation; maximum is the L-infinity norm.
//
// Source: Wang, Ferguson, Schneider, Jiang, Attene, Panozzo, "A Large-Scale Benchmark and an Inclusion-Based
// Algorithm for Continuous Collision Detection", ACM Transactions on Graphics 40(5), 2021, section 6.
enum class Norm { euclidean, maximum };
// A tree of boxes, a grid of hashed cells, all pairs; automatic is the tree. All find the same candidates.
enum class BroadPhaseMethod { automatic, bvh, hash, brute };
// inclusion: the root finder of Wang et al. 2021 (as above) alone. automatic: conservative advancement by
// certificates first (docs/theory.md, sections 2 to 10; akin to the additive CCD of Li, Kaufman, Jiang,
// "Codimensional Incremental Potential Contact", ACM Transactions on Graphics 40(4), 2021), and that root
// finder as the last resort.
enum class NarrowPhaseMethod { automatic, inclusion };
// Which copy of the code runs; the answers are the same bytes. automatic: what ONSET_KERNEL in the
// environment says (scalar, avx2, avx512), else the best there is. The environment is read once, by the first
// call with automatic; what is set later changes nothing. A call throws std::invalid_argument for one that
// the processor or the build lacks, and each call with automatic for another word in ONSET_KERNEL.
enum class InstructionSet { automatic, scalar, avx2, avx512 };
// How far a call goes to tell a real contact from one that only comes within the tolerance, at separation 0
// (docs/exactness.md). No level misses a contact.
// conservative: not at all.
// certify: a certificate in doubles, and where that fails a search in integers of fixed width, microseconds a
// contact at most. What is proved to be no contact is dropped, what is proved real is marked certain, the
// rest stays.
// exact: until it is known, so that every contact reported is real for the stored positions.
// Whether a start within rounding of touching does touch is always decided exactly.
enum class Exactness { conservative, certify, exact };

// What every call may be told; the defaults suit most scenes. Values out of the ranges below make the call
// throw std::invalid_argument that names the option.
//
// Example:
//   onset::Options options;
//   options.min_separation = 1e-3;
//   options.exactness = onset::Exactness::exact;
//   const onset::StepResult r = onset::compute_collision_free_stepsize(mesh, x_t0, x_t1, options);
//   x = x_t0 + r.step * (x_t1 - x_t0);
struct Options {
  // Model length, finite, > 0: a pair may be reported once it is closer than min_separation + tolerance.
  // Unset: relative_tolerance (finite, > 0) times R, the largest corner difference of an overlapping pair
  // (Stats::extent). Stats::tolerance has the value used. A larger one saves time and reports more pairs that
  // do not touch; no value misses one that does.
  std::optional<double> tolerance;
  double relative_tolerance = 1e-6;

  // d: model length, in [0, 2^1020], never reduced but by what the mesh says of a pair
  // (CollisionRules::body_separations, rest_positions). A pair is reported if it ever comes as close as d
  // (plus the thickness of its vertices, CollisionRules::thickness), measured in `norm`. It is never reported
  // if it always stays farther away than d + tolerance, nor, by an active set, if it starts beyond d and
  // never loses three quarters of that excess (resting contact).
  double min_separation = 0;
  Norm norm = Norm::euclidean;

  // >= 1: the checks (certificates of the advancement, boxes of the inclusion root finder) that one pair may
  // cost. When they run out, the time reached so far is returned, which is never late. Nearly all pairs need
  // fewer than 30; the default keeps the worst query below 10 ms.
  std::int64_t max_checks = 10000;

  // Of an active set: time in units of the step, >= 0 or infinite. Only contacts with toi <= earliest toi +
  // window are reported, bit for bit as without a window; what happens later is not looked at closely.
  double window = std::numeric_limits<double>::infinity();

  // The three budgets of one call, each >= 0. When one is spent the answer is safe and has an outcome of its
  // own: a step of 0, an active set that says how far it is complete (ActiveSet::complete_until), candidates
  // that are counted but not listed.
  //
  // Checks of all pairs together. Whether they are spent, and what is answered then, is the same for any
  // number of threads; the budget may be overrun by one wave of work (16 blocks of pairs at first, 1024 at
  // most).
  std::int64_t check_limit = std::numeric_limits<std::int64_t>::max();
  // Bytes of what is kept for each pair: 256 a contact of an active set (the earliest ones are kept), 88 a
  // close pair, 8 a candidate that is listed, or held by a LineSearch (which else finds them again at each
  // step size: the same answers, later). Lists other than active sets take as much again while they are put
  // in order. Not in it: positions, boxes and tree (about 400 bytes a vertex, face and edge) and, for each
  // thread, a batch of pairs. The answer is the same for any number of threads.
  std::int64_t memory_limit = std::numeric_limits<std::int64_t>::max();
  // Seconds since the call began. What it cuts off depends on the machine and on the moment: this alone does
  // not give the same bytes each time. A step cut off is 0, not a shorter one, since even the shortest of
  // steps takes a look at all pairs of neighbours, most of the cost of the whole call. compute_cfl_stepsize,
  // which is given their distances, has a bound instead of 0.
  //
  // A vertex that is flung far away, as by a solver that diverged, makes nearly every pair a candidate: the
  // call may take minutes. Give a limit in a loop.
  //
  // Every call that has options looks at the clock in each of its phases: while boxes and trees are made,
  // every few pairs, also where all of them are in one place, and while what was found is put in order. It
  // returns after no more than what each thread is at, 16 pairs (none is broken off: tens of microseconds
  // each, below 10 ms at the default max_checks), or 50 ms more a thread, up to a million triangles. Beyond
  // that: to give back memory takes 0.1 s a gigabyte, what a mesh keeps of its static parts is made to the
  // end, once, and compute_cfl_stepsize reads its list to the end, 20 ns a pair. Single queries, which take
  // one pair, and calls without options do not look.
  double time_limit = std::numeric_limits<double>::infinity();

  // Is called with the share of the pairs looked at so far, in [0, 1], first with 0 before any work, then
  // each time that a task is done or 10 ms are over, as far as a call looks at the clock (above), and cancels
  // the call by returning false (Outcome::cancelled), as promptly as time_limit. A call that looks at pairs
  // more than once begins again with 0. It runs in the floating-point environment of the library, and may run
  // parallel work of its own. One thread calls at a time, the caller's or one of its arena's; an exception
  // that it throws leaves the call. It must not call into the same LineSearch.
  std::function<bool(double)> progress;

  // 0: the call runs in the caller's oneTBB task arena, as it is; where onset is built without TBB, in as
  // many threads as the hardware has. n >= 1: in an arena of its own, of n threads at most. The answer is the
  // same bytes. Where oneTBB cannot make the first thread that a process wants, a call throws its
  // std::runtime_error; 1 wants none. Where n is more than there are cores, oneTBB itself may warn of it on
  // stderr, once a process.
  int threads = 0;

  // With a separation > 0, contacts after the start are marked certain at level exact only, where a point of
  // each primitive was found that are no farther apart than that.
  Exactness exactness = Exactness::certify;

  // false: a pair whose gap at x_t0 is exactly 0 blocks the step, since from which side it came is not in the
  // positions, and a motion that seems to part it may as well push it through.
  // true: such a pair may leave its contact in any direction, as if that were the side it came from, and what
  // touches within rounding of the start is not looked at: StepResult::toi and is_step_collision_free do not
  // count it. It is meant for starts that are known to touch from the right side.
  bool touching_may_pass_through = false;

  BroadPhaseMethod broad_phase = BroadPhaseMethod::automatic;
  // Whether the mesh may hold candidate pairs from one call to the next, at most 64 bytes a vertex, face and
  // edge, and memory_limit, with up to 200 bytes a vertex for positions and boxes (330 where vertices are
  // static): where positions hardly change between calls, as in the iterations of a Newton solver, only these
  // are then tested. While they are taken, up to three times as much is in use. The answer is the same bytes;
  // Stats::broad_phase is "held". Mesh::release_memory gives the memory back.
  bool hold_candidates = true;
  NarrowPhaseMethod narrow_phase = NarrowPhaseMethod::automatic;
  InstructionSet instruction_set = InstructionSet::automatic;
};

}  // namespace onset
