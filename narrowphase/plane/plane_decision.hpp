// One vertex and one plane: closed form, decided exactly.
#pragma once

#include <optional>

#include "narrowphase/narrow_phase.hpp"
#include "narrowphase/plane/oriented_plane.hpp"
#include "narrowphase/plane/plane_question.hpp"

namespace onset {

struct PlaneAsk {
  // The step's end is stored: the result has a stored_limit, and the share `gap_share`, in [0, 1), of the
  // initial gap is kept.
  bool stored = false;
  double gap_share = 0;
  bool touching_may_pass_through = false;
};

// Makes the question of a plane and two positions in the order of its axes.
inline PlaneQuestion question_of(const OrientedPlane& n, const double* x0, const double* x1,
                                 double separation, bool maximum_norm) {
  return {n.normal, n.offset, x0, x1, separation, maximum_norm};
}

// Decides how far the pair lets a step go; none where it does not limit it at all. Notes a share of a gap
// that the pair is not sure to keep.
std::optional<PairResult> decide_plane(const OrientedPlane& plane, const PlaneQuestion& question,
                                       const PlaneAsk& ask, IdPair pair, NarrowPhaseStats& stats);

// The vertex at x0.
struct PlaneStart {
  // On the plane or behind it; no farther from it than the separation, in the norm asked for. Both exact.
  bool touches, within;
  // Of the vertex and the half-space, Euclidean, model length: within 2^-49 of it, relatively, or by half of
  // the smallest number.
  double distance;
};
// Returns a lower bound of the exact distance: the product rounds once, by half of the smallest number too.
inline double below_plane_distance(double distance) {
  return std::max(0.0, distance * (1 - 0x1p-48) - 0x1p-1074);
}
PlaneStart start_at_plane(const OrientedPlane& plane, const PlaneQuestion& question);

// Returns the sign of how n.x - offset changes in the whole motion, exactly.
int sign_of_motion(const PlaneQuestion& question);

// At time t in [0, 1]: the distance as above, and how much it grows in the whole step where the vertex is in
// front of the plane (< 0: the vertex comes closer), relatively to within 2^-49 too.
struct PlaneGeometry {
  double distance, speed;
};
PlaneGeometry geometry_at_plane(const OrientedPlane& plane, const PlaneQuestion& question, double t);

}  // namespace onset
