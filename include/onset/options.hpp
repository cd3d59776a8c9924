// What a caller may choose: accuracy, separation, budget, algorithms, threads.
#pragma once

#include <cstdint>
#include <optional>

namespace onset {

enum class Norm {
  euclidean,
  maximum
};  // of the minimum separation; `maximum` is the paper's L-infinity (section 6)
enum class BroadPhaseMethod { automatic, bvh, hash, brute };
enum class NarrowPhaseMethod {
  automatic,
  inclusion
};                                              // automatic: certificates first, inclusion as the last resort
enum class Kernel { automatic, scalar, avx2 };  // automatic: ONSET_KERNEL in the environment, else the best

struct Options {
  // A contact is reported once a pair is closer than min_separation + tolerance (model length, > 0). Unset:
  // relative_tolerance times the scene's R, the largest corner difference of an overlapping pair. The value
  // used is reported in the result. The tolerance trades time for false positives; misses never happen at any
  // value.
  std::optional<double> tolerance;
  double relative_tolerance = 1e-6;

  double min_separation = 0;  // model length, >= 0: pairs must stay farther apart than this, in `norm`
  Norm norm = Norm::euclidean;

  // Checks (certificates of the advancement, boxes of the inclusion root finder) one pair may cost, >= 1. When they run out, the
  // time reached so far is returned: conservative, never late. Nearly all pairs need fewer than 30; the default keeps the
  // worst query below 10 ms.
  std::int64_t max_checks = 10000;

  // 0: in the caller's task arena, as it is. n >= 1: at most n threads in an arena of the call.
  int threads = 0;

  BroadPhaseMethod broad_phase = BroadPhaseMethod::automatic;
  NarrowPhaseMethod narrow_phase = NarrowPhaseMethod::automatic;
  Kernel kernel = Kernel::automatic;
};

}  // namespace onset
