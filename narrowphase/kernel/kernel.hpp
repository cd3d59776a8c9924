// What the narrow-phase kernels take and give: plain data, shared by every instruction set's copy of the
// kernel text.
#pragma once

#include "base/unit_roundoff.hpp"

namespace onset {

// Pairs of one kind. Vertex ids: vertex-face v, f0, f1, f2; edge-edge a0, a1, b0, b1.
struct KernelPairs {
  const double* x;           // kMotionStride doubles a vertex (scene/motion.hpp)
  const float* rounded;      // kFloatStride floats a vertex (float_positions.hpp), scaled by `scale`; null: not there
  const int (*vertices)[4];  // one row a pair
  const double* separation;  // d of each pair, model length
  int count;
  double scale;                // a power of two that brings the scene's largest corner difference near 1
  double tolerance;  // model length
  double sharpest;   // scaled: the tolerance is at most this share of a pair's largest corner difference
  double reach;      // a pair reported at time t within its checks is within what it must keep + reach then, model length
  // Beyond d a pair must also keep this share of its initial gap, in [0, 1), and, where storing > 0, kStoredRoundings times the
  // bound storing * (its largest coordinate) + kStoredLeast, model length; but never more than half of what the share leaves. Then
  // also a pair whose gap is too small for that, or not known well, is `initial`.
  double gap_share, storing;
  double cull_beyond;   // model length: kStoredRoundings times that bound for all pairs, for the culls; 0 where storing is 0
  double cull_t_max;  // pairs certified apart until then by the culls, or
  double t_max;       // beyond this time by advancement, may be dropped as free
  bool maximum_norm;  // d is measured in the L-infinity norm
  long long max_checks;
};

// Of the rounding of stored positions, so much is kept where the gap has room: the next step then finds three left.
constexpr double kStoredRoundings = 4;
constexpr double kStoredLeast = 0x1p-1070;

enum class Verdict : int {
  free,     // certified apart on the whole step (or beyond t_max)
  contact,  // within d + delta at t
  initial,  // not certifiably farther apart than d at t = 0, or not by enough to be stored
  stalled,  // apart until t, progress slow
  max_checks,  // spent: apart until t
};

// Where a pair ended; scaled lengths are in units of `unit` (a power of two, model length).
struct KernelResult {
  double t;         // certified apart on [0, t]
  double distance;  // scaled upper bound of the distance at t
  double delta;     // scaled tolerance used: contact means distance - d <= delta
  double separation;  // scaled d, with what `gap_share` and `storing` add
  double unit;
  long long checks;
  Verdict verdict;
  double touched_by;  // the pair certainly touches by this time; 2: not known
};

// Where advancement goes on with a pair that stalled.
struct KernelResume {
  double t, separation, delta;
  long long checks;
  double patience;  // crawling checks allowed beyond the usual ones
};

// Where a pair touches, in the order of axes of the motion. Only where it is ordinary (contact_geometry.inl) do the rest hold.
struct KernelContact {
  double weight[4], normal[3];
  double gap, speed;  // model length
  bool ordinary;
};

// The kernels of one kind of pair.
struct KernelsOfKind {
  // Writes the indices of the pairs that single precision cannot certify as apart on the whole step; returns
  // their number.
  int (*cull)(const KernelPairs&, int* survivors);
  // Directional conservative advancement of the pairs subset[0..count), results at the same positions as in
  // subset. From t = 0, or from resume[0..count) where it is not null.
  void (*advance)(const KernelPairs&, const int* subset, int count, const KernelResume* resume, KernelResult*);
  // Sets touched_by of those of results[0..count), as advance left them, that are in contact and have no separation.
  void (*certify)(const KernelPairs&, const int* subset, int count, KernelResult* results);
  // Contact points, normals, gaps and speeds of pairs 0..count at the times t; separations are not read.
  void (*contact_geometry)(const KernelPairs&, const double* t, KernelContact*);
  // The direction that separates pair `row` best at time t; returns a scaled upper bound of the distance then.
  double (*closest_direction)(const KernelPairs&, int row, double t, double (&w)[3]);
};

struct KernelTable {
  const char* name;
  KernelsOfKind of_kind[2];  // by PairKind
};

const KernelTable& scalar_kernels();
#ifdef ONSET_HAVE_AVX2
const KernelTable& avx2_kernels();
#endif

}  // namespace onset
