// The positions of a step, checked and copied into one plain array.
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <vector>

#include "base/aligned.hpp"
#include "base/assert.hpp"
#include "onset/export.hpp"
#include "onset/result.hpp"
#include "onset/views.hpp"
#include "scene/motion/static_motion.hpp"
#include "scene/primitive_filter.hpp"

namespace onset {

// Beyond this a difference of differences could overflow.
inline constexpr double kMaxCoordinate = 0x1p1020;

// A vertex has one cache line: x y z 0 at t = 0, x y z 0 at t = 1.
inline constexpr int kMotionStride = 8;

// Holds all positions. The axes are stored in an order that does not depend on how the caller names them
// (scene/motion/canonical_axes.hpp), so that everything after this is bit for bit the same for a scene with
// its axes exchanged.
struct Motion {
  // kMotionStride doubles a vertex.
  AlignedArray<double> x;
  int num_vertices = 0;
  // axes[i] is the caller's column that is stored as axis i.
  std::array<int, 3> axes{0, 1, 2};
  // Whether the third axis is a plane's, where all is 0, which then stays the third.
  bool in_plane = false;
  // free, non_finite or out_of_range; not free: the first such vertex is bad_vertex.
  Outcome status = Outcome::free;
  int bad_vertex = -1;
  // Of a part of a scene: the largest magnitude of a coordinate anywhere in it.
  double largest_elsewhere = 0;
  // Whether the rows of static vertices are those of `static_part`, bit for bit, at both ends.
  bool rows_last = false;
  // Null where no static primitive takes part, or status is not free.
  std::shared_ptr<const StaticMotion> static_part;

  const double* t0(int v) const {
    ONSET_ASSERT(v >= 0 && v < num_vertices);
    return x.data() + std::size_t(v) * kMotionStride;
  }
  const double* t1(int v) const { return t0(v) + 4; }
};

// Returns free, non_finite or out_of_range, for three coordinates.
ONSET_API Outcome outcome_of_position(const double* x);

// Makes the motion from x_t0 to x_t1. Throws std::invalid_argument unless both have num_vertices rows of 3.
// axes: if given, these are its axes, not those that follow from the positions.
Motion make_motion(int num_vertices, const Positions& x_t0, const Positions& x_t1, bool in_plane = false,
                   const std::array<int, 3>* axes = nullptr);

// Checks that x has one row of mesh.dimension coordinates for each vertex, else throws std::invalid_argument,
// and returns it in three columns.
Positions in_space(const MeshData& mesh, const char* name, const Positions& x);

// Does the same for a mesh and keeps its static part there. Throws also where a static vertex moves, naming
// it.
Motion make_motion(const MeshData& mesh, const Positions& x_t0, const Positions& x_t1);

// Checks the positions already stored in m.x and brings the axes into canonical order, or that of `axes`.
void finish_motion(Motion& m, const std::array<int, 3>* axes = nullptr);

// Says whether same(i, j) holds for a point i < first of one side and a point j in [first, count) of the
// other.
template <class Same>
bool any_across(int first, int count, Same&& same) {
  for (int i = 0; i < first; ++i)
    for (int j = first; j < count; ++j)
      if (same(i, j)) return true;
  return false;
}
// Returns how many of the four vertices of a pair are on its first side.
inline int points_of_first_side(PairKind kind) { return kind == PairKind::edge_edge ? 2 : 1; }
// Compares exactly; zeros of either sign are alike.
inline bool at_one_place(const double* x, const double* y) {
  return x[0] == y[0] && x[1] == y[1] && x[2] == y[2];
}

// Says whether a vertex of one side is where one of the other side is, at both ends: MeshData::weld.
bool is_seam(const Motion& m, PairKind kind, const std::array<int, 4>& vertices);

}  // namespace onset
