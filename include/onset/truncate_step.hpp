// A step for each vertex: how far each may go on its own, where one step for all is as short as the worst
// pair.
#pragma once

#include <cstddef>
#include <onset/export.hpp>
#include <onset/mesh.hpp>
#include <onset/options.hpp>
#include <onset/result.hpp>
#include <optional>
#include <vector>

namespace onset {

struct TruncateOptions : Options {
  TruncateOptions() = default;
  // NOLINTNEXTLINE: implicit by design, for who needs no more.
  TruncateOptions(const Options& options) : Options(options) {}

  // In [0, 1): every pair that the motion can bring together (whose swept boxes meet) keeps at least this
  // share of its gap along the normal of its plane, so that the next step has room too.
  double gap_share = 0.1;
  // Model length, in (0, 2^1020]. Set: no vertex goes farther than half of it (but for the rounding of one
  // double), so that only pairs that are no farther apart than d_hat beyond their separation are looked at: a
  // bound of what long motions cost. Unset: a vertex may go all its way, and the pairs looked at are those
  // that the motion can bring together.
  std::optional<double> d_hat;
};

struct TruncatedStep {
  // x y z of each vertex (in the plane x y), as many as the mesh has: `Positions(p.data(), #V, dimension())`.
  // What is safe to store, as it is: exactly x_t1 where nothing limits the vertex, and exactly x_t0 where it
  // may not move.
  std::vector<double> positions;
  // The same as a change of x_t0. x_t0 + displacement, rounded to doubles, is `positions` but for the last
  // bit of vertices that go all their way, and as safe.
  std::vector<double> displacements;
  // The share of its motion that each vertex keeps (#V values in [0, 1]), and of the lengths of all together;
  // 1 where nothing moves.
  std::vector<double> share;
  double kept = 0;
  // The pairs that limit a vertex, ordered by (kind, a, b), and for each vertex the row of the one that
  // limits it most, or -1: also where d_hat alone does.
  std::vector<Pair> pairs;
  std::vector<int> limited_by;

  // free: no pair limits a vertex. contact: one does. initial_contact: a pair touches, and its vertices stay.
  // below_rounding: none touches, but one is so close that no plane in doubles tells its sides apart, and its
  // vertices stay. non_finite, out_of_range, out_of_time, out_of_memory, cancelled: no vertex moves.
  Outcome outcome = Outcome::free;
  // The pair that the outcome is about: the first that touches, or has no plane, else the one that cuts a
  // motion to the least share.
  std::optional<Pair> limiting;
  // The offending vertex of non_finite and out_of_range, else -1.
  int vertex = -1;
  Stats stats;
};

// Cuts the motion of each vertex so that no pair meets, and no vertex is held up by pairs far away.
//
// Guarantee: no pair touches, or comes as close as its separation, while every vertex moves on a straight
// line from x_t0 to its `positions` (or to x_t0 + displacement as stored), all at one pace or each at its
// own, and wherever each may stop. A pair that starts apart and within its separation, or beyond it by no
// more than rounding (2^-44 of its size), comes no closer than it is along the normal of its plane. Each
// vertex of a pair stays on its side of a plane, which is proved for the doubles that are returned; no bound
// in that is an absolute length. Vertices that CollisionRules::weld counts as one go together, and so do all
// of a rigid body, by one share. The same bytes for any number of threads and any instruction set.
//
// x_t0, x_t1: #V x 3 (in the plane #V x 2), model length, the two ends of a linear motion; x_t0 is assumed to
// be free of intersections (check() in onset/check.hpp tells). options: separation, budgets, gap_share,
// d_hat. Accuracy, check_limit and touching_may_pass_through are not used; memory_limit counts 104 bytes a
// pair that may limit a vertex. Throws std::invalid_argument for a wrong number of rows or columns, a static
// vertex that moves, options out of range. Safe to call concurrently on one Mesh.
//
// Source: planes in proportion to the approach, and truncation of each vertex at its planes, are those of
// "Divide and Truncate: A Penetration and Inversion Free Framework for Coupled Multi-physics Systems",
// SIGGRAPH 2026; the choice of normals, the treatment of rounding and the proof: docs/per-vertex-steps.md.
//
// Example:
//   const onset::TruncatedStep r = onset::truncate_step(mesh, x_t0, x_t1);
//   x = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>>(
//       r.positions.data(), mesh.num_vertices(), 3);
ONSET_API TruncatedStep truncate_step(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1,
                                      const TruncateOptions& options = {});

}  // namespace onset
