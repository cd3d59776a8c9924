// What the narrow-phase kernels take and give: plain data that all instruction sets share.
#pragma once

#include "base/unit_roundoff.hpp"

namespace onset {

// Pairs of one kind, with vertices v, f0, f1, f2 or a0, a1, b0, b1, or in the plane v, e0, e1, e1: as a face
// of two corners, which all but certify and contact_geometry take it for. Lengths are model lengths, unless
// they are scaled: in units of the pair.
struct KernelPairs {
  // Rows of kMotionStride doubles a vertex.
  const double* x;
  // Rows of kFloatStride floats a vertex, positions times `scale`; or null.
  const float* rounded;
  const int (*vertices)[4];
  // The separation d of each pair.
  const double* separation;
  int count;
  // A power of two that brings the scene's largest corner near 1.
  double scale;
  double tolerance;  // model length
  // Scaled; the tolerance is at most this.
  double sharpest;
  // A pair reported before its checks are spent is within what it must keep + `reach`.
  double reach;
  // Beyond d a pair keeps this share, in [0, 1), of its initial gap and, where storing > 0, kStoredRoundings
  // times (storing * its largest coordinate + kStoredLeast), but never more than half of what the share
  // leaves. A pair without room for it, or whose gap is not known well, is `initial`.
  double gap_share, storing;
  // kStoredRoundings times that bound for all pairs, for the culls; 0 where storing is 0.
  double cull_beyond;
  // The culls may drop pairs that are apart until cull_t_max, advancement those apart beyond t_max.
  double cull_t_max;
  double t_max;
  bool maximum_norm;
  long long max_checks;
  // All third coordinates are 0, and pairs are a vertex and an edge.
  bool in_plane;
};

// So many roundings of stored positions are kept where there is room: three are left to the next step.
constexpr double kStoredRoundings = 4;
constexpr double kStoredLeast = 0x1p-1070;

enum class Verdict : int {
  // Certified apart on the whole step, or beyond t_max.
  free,
  // A witness at t is within d + delta.
  contact,
  // Not certified to be beyond d at t = 0, or not by enough to be stored.
  initial,
  // Certified apart until t; progress is slow.
  stalled,
  // Certified apart until t; the checks are spent.
  max_checks,
};

// Where advancement left a pair. Lengths are scaled, in units of `unit`: a power of two, model length.
struct KernelResult {
  // The pair is certified apart on [0, t].
  double t;
  // An upper bound of the distance at t, the tolerance used, and d with what gap_share and storing add.
  double distance;
  double delta;
  double separation;
  double unit;
  long long checks;
  Verdict verdict;
  // The pair certainly touches by this time; 2 where that is not known.
  double touched_by;
};

// Where advancement goes on with a pair that stalled.
struct KernelResume {
  double t, separation, delta;
  long long checks;
  // Slow checks that are allowed beyond the usual ones.
  double patience;
};

// Where a pair touches, in the motion's order of axes. Only `ordinary` ones (contact_geometry.inl) have
// values.
struct KernelContact {
  double weight[4], normal[3];
  double gap, speed;  // model length
  bool ordinary;
};

// The kernels of one kind of pair.
struct KernelsOfKind {
  // Writes the indices of the pairs that single precision cannot certify as free; returns their number.
  int (*cull)(const KernelPairs&, int* survivors);
  // Advances the pairs subset[0..count) from t = 0, or from resume[0..count); results are in the order of
  // subset.
  void (*advance)(const KernelPairs&, const int* subset, int count, const KernelResume* resume,
                  KernelResult*);
  // Sets touched_by of results of `advance` that are contacts without separation.
  void (*certify)(const KernelPairs&, const int* subset, int count, KernelResult* results);
  // Finds contact points, normals, gaps and speeds at the times t; separations are not read.
  void (*contact_geometry)(const KernelPairs&, const double* t, KernelContact*);
  // Finds the direction that separates pair `row` best at t; returns a scaled upper bound of the distance.
  double (*closest_direction)(const KernelPairs&, int row, double t, double (&w)[3]);
};

struct KernelTable {
  const char* name;
  // By PairKind.
  KernelsOfKind of_kind[3];
};

const KernelTable& scalar_kernels();
#ifdef ONSET_HAVE_AVX2
const KernelTable& avx2_kernels();
#endif
#ifdef ONSET_HAVE_AVX512
const KernelTable& avx512_kernels();
#endif

}  // namespace onset
