// The calls of ipc-toolkit's collision detection by their names there, so that code for it compiles after
// changing an include and a namespace (ipc becomes onset::ipc): docs/from-ipc-toolkit.md lists them, and what
// differs. Linear motion only; in two dimensions rest positions and all others have two columns. What Onset
// says beyond a number (outcome, limiting pair) is in onset/step_size.hpp.
//
// Source: the collision detection of Li, Ferguson, Schneider, Langlois, Zorin, Panozzo, Jiang, Kaufman,
// "Incremental Potential Contact: Intersection- and Inversion-free, Large-Deformation Dynamics", ACM
// Transactions on Graphics 39(4), 2020, as ipc-toolkit (https://github.com/ipc-sim/ipc-toolkit) offers it;
// what computes it here is in docs/theory.md.
//
// Example:
//   namespace ipc = onset::ipc;
//   const ipc::CollisionMesh surface(x_t0, onset::edges(F), F);
//   const double step = ipc::compute_collision_free_stepsize(surface, x_t0, x_t1);
//   x = x_t0 + step * (x_t1 - x_t0);
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <onset/compat/arguments.hpp>
#include <onset/compat/broad_phase.hpp>
#include <onset/compat/candidates.hpp>
#include <onset/compat/collision_filter.hpp>
#include <onset/compat/collision_mesh.hpp>
#include <onset/compat/narrow_phase.hpp>
#include <onset/compat/stencils.hpp>
#include <onset/intersections.hpp>
#include <onset/line_search.hpp>
#include <onset/step_size.hpp>

namespace onset::ipc {

// Computes a step in [0, 1] from vertices_t0 towards vertices_t1 that is free of contact and leaves room for
// the next one (conservative_rescaling).
//
// Guarantee: no pair comes as close as min_distance, along the exact motion x0 + s dx, s in [0, step], and as
// the end of that is stored, with dx = vertices_t1 - vertices_t0 rounded to doubles (vertices_t1 itself,
// where can_collide is set). NaN, infinities and |x| > 2^1020: 0.
//
// vertices_t0, vertices_t1: #V x dim, surface positions; vertices_t0 is assumed to be free of intersections.
// min_distance: model length, >= 0.
// broad_phase: which of Onset's it stands for (BroadPhase::onset_method).
// ccd: one of Onset's (CertifiedCCD); of a class of your own the four functions are asked for each candidate,
// and the guarantee is what that class promises.
// Throws std::invalid_argument for a wrong number of rows, and for min_distance and values of `ccd` out of
// range.
// Safe to call concurrently on one mesh where can_collide is.
inline double compute_collision_free_stepsize(const CollisionMesh& mesh, const Vertices& vertices_t0,
                                              const Vertices& vertices_t1, double min_distance = 0,
                                              const BroadPhase* broad_phase = nullptr,
                                              const NarrowPhaseCCD& ccd = DEFAULT_NARROW_PHASE_CCD) {
  mesh.require_surface(*vertices_t0), mesh.require_surface(*vertices_t1);
  return in_environment([&]() -> double {
    if (!mesh.can_collide.accepts_all() || !ccd.onset_options()) {
      Candidates candidates;
      if (!candidates.build_if_finite(mesh, vertices_t0, vertices_t1, min_distance / 2, broad_phase))
        return 0;
      return candidates.compute_collision_free_stepsize(mesh, vertices_t0, vertices_t1, min_distance, ccd);
    }
    LineSearchOptions options = options_of(min_distance, ccd, broad_phase);
    options.gap_share = compat::kept_share(ccd.conservative_rescaling);
    return LineSearch(mesh.onset_mesh(), *vertices_t0, Eigen::MatrixXd(*vertices_t1 - *vertices_t0), options)
        .largest_step()
        .step;
  });
}

// Tells, exactly, whether an edge and a face (in two dimensions two edges) without a common vertex have a
// common point, a touch is one, or a vertex is on a plane or behind it.
// Also true for NaN.
//
// Parameters, errors, thread safety: as compute_collision_free_stepsize.
inline bool has_intersections(const CollisionMesh& mesh, const Vertices& vertices,
                              const BroadPhase* broad_phase = nullptr) {
  const onset::Mesh all = mesh.onset_mesh();
  Options options;
  if (broad_phase != nullptr) options.broad_phase = broad_phase->onset_method();
  if (mesh.can_collide.accepts_all()) return onset::has_intersections(all, *vertices, options);
  const Intersections found = intersections(all, *vertices, options);
  const auto may = [&](const Intersection& p) {
    return may_collide(mesh.can_collide, p.vertices.data(), 2, p.vertices.data() + 2, 3);
  };
  return found.outcome != Outcome::free || !found.behind_planes.empty() ||
         std::any_of(found.begin(), found.end(), may);
}

// Tells whether the whole exact motion is certified free of contact. False also where that is not known.
//
// Parameters, errors, thread safety: as compute_collision_free_stepsize.
inline bool is_step_collision_free(const CollisionMesh& mesh, const Vertices& vertices_t0,
                                   const Vertices& vertices_t1, double min_distance = 0,
                                   const BroadPhase* broad_phase = nullptr,
                                   const NarrowPhaseCCD& ccd = DEFAULT_NARROW_PHASE_CCD) {
  mesh.require_surface(*vertices_t0), mesh.require_surface(*vertices_t1);
  return in_environment([&]() -> bool {
    if (mesh.can_collide.accepts_all() && ccd.onset_options())
      return onset::is_step_collision_free(mesh.onset_mesh(), *vertices_t0, *vertices_t1,
                                           options_of(min_distance, ccd, broad_phase));
    Candidates candidates;
    if (!candidates.build_if_finite(mesh, vertices_t0, vertices_t1, min_distance / 2, broad_phase))
      return false;
    return candidates.is_step_collision_free(mesh, vertices_t0, vertices_t1, min_distance, ccd);
  });
}

}  // namespace onset::ipc
