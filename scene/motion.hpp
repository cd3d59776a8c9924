// A step's positions, checked and copied once into plain arrays, and the scene-wide sizes the error bounds
// come from.
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <vector>

#include "base/aligned.hpp"
#include "onset/result.hpp"
#include "onset/views.hpp"
#include "scene/primitive_filter.hpp"

namespace onset {

inline constexpr double kMaxCoordinate = 0x1p1020;  // beyond this a difference of differences could overflow

// One cache line a vertex: x y z 0 at t = 0, x y z 0 at t = 1.
inline constexpr int kMotionStride = 8;

// What the steps have in common as long as static vertices stay where they are: immutable but for memory
// to use again, safe to share.
class StaticMotion {
 public:
  std::vector<double> x;                               // x y z of each static vertex, in the order of ids
  std::array<std::vector<double>, 3> column;           // the same by column
  bool contiguous = true;                              // the ids are
  std::array<double, 3> lo{}, hi{};                    // per column
  std::array<double, 3> widest_edge{}, widest_face{};  // of the static primitives that take part, rounded up

  // Whether static vertices are there, at one end of a motion.
  bool stands_at(const std::vector<int>& ids, const Positions& positions) const;

  // Motion::x of an earlier motion with these axes, whose rows of static vertices still hold; empty if none
  // is kept. At most two are.
  AlignedArray<double> take(const std::array<int, 3>& axes) const;
  void give_back(const std::array<int, 3>& axes, AlignedArray<double> rows) const;

 private:
  struct Rows {
    std::array<int, 3> axes;
    AlignedArray<double> x;
  };
  mutable std::mutex mutex_;
  mutable std::array<Rows, 2> kept_;
};

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

  const double* t0(int v) const { return x.data() + std::size_t(v) * kMotionStride; }
  const double* t1(int v) const { return x.data() + std::size_t(v) * kMotionStride + 4; }
};

// Throws std::invalid_argument when a row count differs from num_vertices or there are not 3 columns.
Motion make_motion(int num_vertices, const Positions& x_t0, const Positions& x_t1);

// The same for all of a mesh; in addition throws std::invalid_argument naming the first static vertex whose
// finite positions differ.
Motion make_motion(const MeshData& mesh, const Positions& x_t0, const Positions& x_t1);

// Checks the positions already stored in m.x and brings the axes into canonical order.
void finish_motion(Motion& m);

// Storing x_t0 + s (x_t1 - x_t0) in doubles errs by at most 5u M + 3 eta a coordinate, M the largest one at both ends and eta
// 2^-1074, whatever the order of operations:
// - x0 + s (x1 - x0): |x1 - x0| <= 2M rounds by 2u M, its product with s by 2u M, the sum by u M;
// - with that product and sum fused, or x1 = x0 + dx rounded (u M) and then x0 + s dx (3u M), by less;
// - (1 - s) x0 + s x1: u for 1 - s, u for each product, u for the sum, weights that sum to 1: 3u M.
// Each product underflows by eta / 2 at most. A point of a primitive moves by no more than its vertices, the distance of two points by
// sqrt(3) times twice that: 10 sqrt(3) u M = 17.4u M; 18.5u covers second order. For the maximum norm it is less.
inline constexpr double kStoring = 18.5 * 0x1p-53;

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

// Model length: that bound of the change of a distance, for all pairs.
double rounding_of_distances(const Motion& m);

// What StepResult::rounding says: twice this is more than twice that bound and what a look at a start cannot tell, 100u of a pair's
// rho, which is below 3.5 M.
inline double reported_rounding(double rounding_of_distances) { return rounding_of_distances * 11; }

// Per stored axis, upper bounds on the largest corner difference |p - v| (vertex-face), |p_i - p_j|
// (edge-edge) that a pair with overlapping swept boxes can have (each side of the pair spans its swept
// extent, and the boxes are at most `gap` apart): R <= w(A) + w(B) + gap. Of primitives that take part.
struct Extents {
  std::array<double, 3> vertex_face{}, edge_edge{};
  double largest() const;  // over kinds and axes
};
Extents corner_extents(const MeshData& mesh, const Motion& motion, double gap);

}  // namespace onset
