// What a caller may choose: accuracy, separation, budget, algorithms, threads.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>

namespace onset {

// Of the minimum separation; maximum is the L-infinity norm (paper, section 6).
enum class Norm { euclidean, maximum };
enum class BroadPhaseMethod { automatic, bvh, hash, brute };
// automatic: certificates first, the inclusion root finder as the last resort.
enum class NarrowPhaseMethod { automatic, inclusion };
// automatic: ONSET_KERNEL in the environment (scalar, avx2), else the best there is.
enum class InstructionSet { automatic, scalar, avx2 };
// How far the pipeline goes to tell a real contact from one that only comes within the tolerance, at
// separation 0 (docs/exactness.md). conservative: not at all. certify: a certificate in doubles, and where
// that fails a search in integers of fixed width, microseconds a contact at most: what is proved to be no
// contact is dropped, what is proved real is marked certain, the rest stays. exact: until it is known, so
// every contact reported is real for the stored positions. A start
// within rounding of touching is always decided exactly.
enum class Exactness { conservative, certify, exact };

struct Options {
  // A pair may be reported once it is closer than min_separation + tolerance (model length, > 0). Unset:
  // relative_tolerance times the scene's R, the largest corner difference of an overlapping pair. The value
  // used is reported in the result. The tolerance trades time for false positives; misses never happen at any
  // value.
  std::optional<double> tolerance;
  double relative_tolerance = 1e-6;

  // d: model length, >= 0, never reduced. A pair is reported if it ever comes as close as d (plus the
  // thickness of its vertices, CollisionRules::thickness), measured in `norm`; it is never reported if it always
  // stays farther away than d + tolerance, nor, by an active set, if it starts beyond d and never loses three quarters of that
  // excess (resting contact).
  double min_separation = 0;
  Norm norm = Norm::euclidean;

  // Checks (certificates of the advancement, boxes of the inclusion root finder) one pair may cost, >= 1.
  // When they run out, the time reached so far is returned: conservative, never late. Nearly all pairs need
  // fewer than 30; the default keeps the worst query below 10 ms.
  std::int64_t max_checks = 10000;

  // Of an active set: time in units of the step, >= 0. Only contacts with toi <= earliest toi + window are
  // reported, bit for bit as without a window, and what happens later is not looked at closely. Infinite:
  // all.
  double window = std::numeric_limits<double>::infinity();

  // Budgets of one call, each >= 0. When one is spent the answer is conservative and has an outcome of its
  // own: a step of 0, an active set of true contacts that says how far it is complete
  // (ActiveSet::complete_until), candidates that are counted but not listed.
  //
  // check_limit: checks of all pairs together. Whether it is spent, and what is answered then, is the same
  // for any number of threads; it may be overrun by one wave of work (16 blocks of pairs at first, 1024 at
  // most).
  std::int64_t check_limit = std::numeric_limits<std::int64_t>::max();
  // memory_limit: bytes of what is kept for each pair: 256 a contact of an active set (the earliest ones are
  // kept), 8 a candidate that is listed or held by a LineSearch (which finds them again at each step size
  // instead: the same answers, later). Not in it: positions, boxes and tree (about 400 bytes a vertex, face
  // and edge) and, for each thread, a batch of pairs. The same answer for any number of threads.
  std::int64_t memory_limit = std::numeric_limits<std::int64_t>::max();
  // time_limit: seconds since the call began, looked at every few pairs and between the phases. What it cuts
  // off depends on the machine and on the moment: the only option that does not give the same bytes each
  // time. A step cut off is 0, not a shorter one: in any mesh boxes of neighbours overlap in the shortest of
  // steps, so that one > 0 takes a look at all of these pairs, most of the cost of the whole call. Who has
  // found their distances before has a bound for it: compute_cfl_stepsize gives that one instead of 0.
  double time_limit = std::numeric_limits<double>::infinity();

  // Called with the share of the pairs looked at so far, in [0, 1], now and then: first with 0, before any
  // work. Returning false cancels the call (Outcome::cancelled). By one thread at a time, the caller's or one
  // of its arena's; an exception it throws leaves the call. Must not call into the same LineSearch.
  std::function<bool(double)> progress;

  // 0: in the caller's task arena, as it is. n >= 1: at most n threads in an arena of the call.
  int threads = 0;

  // With a separation > 0, contacts after the start are marked certain at level exact only, where a point of each
  // primitive was found that are no farther apart than that.
  Exactness exactness = Exactness::certify;

  // A pair whose gap at x_t0 is exactly 0 blocks the step: from which side it came is not in the positions, so a motion
  // that seems to part it may as well push it through. true: such a pair may leave its contact in any direction, as
  // if that were the side it came from, and what touches within rounding of the start is not looked at: StepResult::toi
  // and is_step_collision_free do not count it. For starts that are known to touch from the right side only.
  bool touching_may_pass_through = false;

  BroadPhaseMethod broad_phase = BroadPhaseMethod::automatic;
  NarrowPhaseMethod narrow_phase = NarrowPhaseMethod::automatic;
  InstructionSet instruction_set = InstructionSet::automatic;
};

}  // namespace onset
