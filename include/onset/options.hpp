// What a caller may choose: accuracy, separation, budget, algorithms, threads.
#pragma once

#include <cstdint>
#include <optional>

namespace onset {

// Of the minimum separation; maximum is the L-infinity norm (paper, section 6).
enum class Norm { euclidean, maximum };
enum class BroadPhaseMethod { automatic, bvh, hash, brute };
// automatic: certificates first, the inclusion root finder as the last resort.
enum class NarrowPhaseMethod { automatic, inclusion };
// automatic: ONSET_KERNEL in the environment (scalar, avx2), else the best there is.
enum class Kernel { automatic, scalar, avx2 };
// How far the pipeline goes to tell a real contact from one that only comes within the tolerance, at separation 0.
// conservative: not at all. certify: a few microseconds for each contact reported, at most; what that proves to be no
// contact is dropped, what it proves real is marked certain. exact: until it is known; every contact reported is real for the
// stored positions (docs/exactness.md).
enum class CertaintyLevel { conservative, certify, exact };

struct Options {
  // A contact is reported once a pair is closer than min_separation + tolerance (model length, > 0). Unset:
  // relative_tolerance times the scene's R, the largest corner difference of an overlapping pair. The value
  // used is reported in the result. The tolerance trades time for false positives; misses never happen at any
  // value.
  std::optional<double> tolerance;
  double relative_tolerance = 1e-6;

  // d: model length, >= 0, never reduced. A pair is reported if it ever comes as close as d (plus the
  // thickness of its vertices, Mesh::set_thickness), measured in `norm`; it is never reported if it always
  // stays farther away than d + tolerance, nor if it starts beyond d and never loses three quarters of that
  // excess (resting contact).
  double min_separation = 0;
  Norm norm = Norm::euclidean;

  // Checks (certificates of the advancement, boxes of the inclusion root finder) one pair may cost, >= 1.
  // When they run out, the time reached so far is returned: conservative, never late. Nearly all pairs need
  // fewer than 30; the default keeps the worst query below 10 ms.
  std::int64_t max_checks = 10000;

  // 0: in the caller's task arena, as it is. n >= 1: at most n threads in an arena of the call.
  int threads = 0;

  // With a separation > 0 (or, in a line search, a share of the gap to keep), and at any level: a contact is marked certain
  // where a point of each primitive was found that are no farther apart than that.
  CertaintyLevel certainty = CertaintyLevel::conservative;

  BroadPhaseMethod broad_phase = BroadPhaseMethod::automatic;
  NarrowPhaseMethod narrow_phase = NarrowPhaseMethod::automatic;
  Kernel kernel = Kernel::automatic;
};

}  // namespace onset
