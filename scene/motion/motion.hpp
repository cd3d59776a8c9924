// A step's positions, checked and copied once into plain arrays, and the scene-wide sizes the error bounds
// come from.
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <vector>

#include "base/assert.hpp"
#include "base/aligned.hpp"
#include "onset/result.hpp"
#include "onset/views.hpp"
#include "scene/motion/static_motion.hpp"
#include "scene/primitive_filter.hpp"

namespace onset {

inline constexpr double kMaxCoordinate = 0x1p1020;  // beyond this a difference of differences could overflow

// One cache line a vertex: x y z 0 at t = 0, x y z 0 at t = 1.
inline constexpr int kMotionStride = 8;

// The three axes are stored in an order that depends on the motion only up to a permutation of axes (see
// canonical_axes), so that everything after this is bit for bit the same for a scene with its axes exchanged.
struct Motion {
  AlignedArray<double> x;  // kMotionStride doubles a vertex
  int num_vertices = 0;
  std::array<int, 3> axes{0, 1, 2};  // axes[i]: the caller's column stored as axis i
  Outcome status = Outcome::free;    // free, non_finite or out_of_range
  int bad_vertex = -1;
  bool rows_last = false;  // rows of static vertices are those of `static_part`, bit for bit, at both ends
  std::shared_ptr<const StaticMotion>
      static_part;  // null where no static primitive takes part, or status is not free

  const double* t0(int v) const {
    ONSET_ASSERT(v >= 0 && v < num_vertices);
    return x.data() + std::size_t(v) * kMotionStride;
  }
  const double* t1(int v) const { return t0(v) + 4; }
};

// Throws std::invalid_argument when a row count differs from num_vertices or there are not 3 columns.
Motion make_motion(int num_vertices, const Positions& x_t0, const Positions& x_t1);

// The same for all of a mesh; in addition throws std::invalid_argument naming the first static vertex whose
// finite positions differ.
Motion make_motion(const MeshData& mesh, const Positions& x_t0, const Positions& x_t1);

// Checks the positions already stored in m.x and brings the axes into canonical order.
void finish_motion(Motion& m);

// Whether a point of one side is another one of the other side, MeshData::weld: same(i, j) of those in [0, first) and [first, count).
template <class Same>
bool any_across(int first, int count, Same&& same) {
  for (int i = 0; i < first; ++i)
    for (int j = first; j < count; ++j)
      if (same(i, j)) return true;
  return false;
}
inline int points_of_first_side(PairKind kind) { return kind == PairKind::vertex_face ? 1 : 2; }
// Exactly, zeros of either sign alike.
inline bool at_one_place(const double* x, const double* y) { return x[0] == y[0] && x[1] == y[1] && x[2] == y[2]; }

// Whether a vertex of one side of a pair is where one of the other is at both ends: a seam.
bool is_seam(const Motion& m, PairKind kind, const std::array<int, 4>& vertices);

}  // namespace onset
