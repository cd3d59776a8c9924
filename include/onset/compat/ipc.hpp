// The calls of ipc-toolkit's collision detection by their names there, so that code for it compiles after
// changing an include and a namespace (ipc becomes onset::ipc). Linear motion only; in two dimensions rest
// positions and all others have two columns. What
// Onset says beyond a number (outcome, limiting pair) is in onset/step_size.hpp.
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
#include <onset/candidates.hpp>
#include <onset/compat/collision_mesh.hpp>
#include <onset/intersections.hpp>
#include <onset/line_search.hpp>
#include <onset/safe_distance.hpp>
#include <onset/step_size.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace onset::ipc {

// Broad phases are objects in ipc-toolkit and Options here: a pointer to this is accepted and ignored.
class BroadPhase {};

// What TightInclusionCCD takes there, the root finder of Wang, Ferguson, Schneider, Jiang, Attene, Panozzo,
// "A Large-Scale Benchmark and an Inclusion-Based Algorithm for Continuous Collision Detection", ACM
// Transactions on Graphics 40(5), 2021.
struct TightInclusionCCD {
  // Options::tolerance: model length, > 0.
  double tolerance = 1e-6;
  // Options::max_checks: the checks that one pair may cost, >= 1.
  long max_iterations = 10000;
  // In (0, 1]: each step keeps 1 - conservative_rescaling of every gap, so that the next one is not 0.
  double conservative_rescaling = 0.8;
};
using NarrowPhaseCCD = TightInclusionCCD;
inline const TightInclusionCCD DEFAULT_NARROW_PHASE_CCD{};

// f() in the library's floating-point environment: what these calls compute themselves is the same bytes
// whatever the host has set.
template <class F>
auto in_environment(const F& f) {
  decltype(f()) result{};
  in_default_float_environment([&] { result = f(); });
  return result;
}

// Makes Options of what ipc-toolkit passes.
inline Options options_of(double min_distance, const NarrowPhaseCCD& ccd) {
  Options o;
  o.min_separation = min_distance;
  o.tolerance = ccd.tolerance;
  o.max_checks = ccd.max_iterations;
  return o;
}

struct VertexVertexCandidate {
  int vertex0_id, vertex1_id;
};
struct EdgeVertexCandidate {
  int edge_id, vertex_id;
};
struct EdgeEdgeCandidate {
  int edge0_id, edge1_id;
};
struct FaceVertexCandidate {
  int face_id, vertex_id;
};
// Of CollisionMesh::set_planes.
struct PlaneVertexCandidate {
  int plane_id, vertex_id;
};

// Pairs whose boxes meet during a motion, less those that can_collide leaves out: data, sorted. The free
// functions below do not need it.
class Candidates {
 public:
  // Of two codim_vertices.
  std::vector<VertexVertexCandidate> vv_candidates;
  // Of one of them and any edge; in two dimensions of any vertex.
  std::vector<EdgeVertexCandidate> ev_candidates;
  std::vector<EdgeEdgeCandidate> ee_candidates;
  std::vector<FaceVertexCandidate> fv_candidates;
  std::vector<PlaneVertexCandidate> pv_candidates;

  // Finds all pairs whose boxes, each wider by inflation_radius (model length, >= 0), meet during the motion.
  // vertices_t0, vertices_t1: surface positions, the two ends of the motion; one: where they stand.
  // Throws std::runtime_error for NaN, infinities and |x| > 2^1020, std::invalid_argument for a wrong number
  // of rows.
  void build(const CollisionMesh& mesh, const Eigen::MatrixXd& vertices_t0,
             const Eigen::MatrixXd& vertices_t1, double inflation_radius = 0, const BroadPhase* = nullptr) {
    clear();
    Options o;
    // Each box is widened by half of it.
    o.min_separation = in_environment([&] { return 2 * inflation_radius; });
    const onset::Candidates found = compute_candidates(mesh.onset_mesh(), vertices_t0, vertices_t1, o);
    if (found.outcome != Outcome::free)
      throw std::runtime_error(std::string("Candidates::build: ") + to_string(found.outcome));
    const auto& can = mesh.can_collide;
    const auto any = [&](const int* first, int firsts, const int* second, int seconds) {
      for (int i = 0; i < firsts; ++i)
        for (int j = 0; j < seconds; ++j)
          if (can(std::size_t(first[i]), std::size_t(second[j]))) return true;
      return false;
    };
    for (const auto& p : found.vertex_face)
      if (!can || any(&p[0], 1, mesh.onset_mesh().face(p[1]).data(), 3))
        fv_candidates.push_back({p[1], p[0]});
    for (const auto& p : found.vertex_plane) pv_candidates.push_back({p[1], p[0]});
    for (const auto& p : found.edge_edge) {
      const auto a = mesh.onset_mesh().edge(p[0]), b = mesh.onset_mesh().edge(p[1]);
      if (can && !any(a.data(), 2, b.data(), 2)) continue;
      if (p[1] < int(mesh.num_edges()))
        ee_candidates.push_back({p[0], p[1]});
      else if (p[0] < int(mesh.num_edges()))
        ev_candidates.push_back({p[0], b[0]});
      else
        vv_candidates.push_back({a[0], b[0]});
    }
    for (const auto& [v, e] : found.vertex_edge) {
      const auto ends = mesh.onset_mesh().edge(e);
      if (can && !any(&v, 1, ends.data(), 2)) continue;
      if (e < int(mesh.num_edges()))
        ev_candidates.push_back({e, v});
      else if (v < ends[0] &&
               std::binary_search(mesh.codim_vertices().begin(), mesh.codim_vertices().end(), v))
        vv_candidates.push_back({v, ends[0]});
    }
  }
  void build(const CollisionMesh& mesh, const Eigen::MatrixXd& vertices, double inflation_radius = 0,
             const BroadPhase* broad_phase = nullptr) {
    build(mesh, vertices, vertices, inflation_radius, broad_phase);
  }

  std::size_t size() const {
    return vv_candidates.size() + ev_candidates.size() + ee_candidates.size() + fv_candidates.size() +
           pv_candidates.size();
  }
  bool empty() const { return size() == 0; }
  void clear() { *this = {}; }

  // As the free functions of these names below, for these pairs alone. Throws std::invalid_argument for ids
  // that the mesh does not have; NaN gives 0 and false.
  double compute_collision_free_stepsize(const CollisionMesh& mesh, const Eigen::MatrixXd& vertices_t0,
                                         const Eigen::MatrixXd& vertices_t1, double min_distance = 0,
                                         const NarrowPhaseCCD& ccd = DEFAULT_NARROW_PHASE_CCD) const {
    const double gap_share = in_environment([&] { return 1 - ccd.conservative_rescaling; });
    return onset::compute_collision_free_stepsize(mesh.onset_mesh(), list(mesh), vertices_t0, vertices_t1,
                                                  options_of(min_distance, ccd), gap_share)
        .step;
  }
  // Computes a step that is free of contact as a whole, not for the pairs listed alone, from those that are
  // within dhat (model length, > 0) of their distance at vertices_t0 and a bound for all others. Every pair
  // keeps its share of its gap, of dhat where it is farther apart, so that the next step is not 0. Where
  // can_collide is set, the bound is not used: the step is that of all pairs that may collide.
  double compute_cfl_stepsize(const CollisionMesh& mesh, const Eigen::MatrixXd& vertices_t0,
                              const Eigen::MatrixXd& vertices_t1, double dhat, double min_distance = 0,
                              const BroadPhase* broad_phase = nullptr,
                              const NarrowPhaseCCD& ccd = DEFAULT_NARROW_PHASE_CCD) const {
    mesh.require_surface(vertices_t0), mesh.require_surface(vertices_t1);
    if (mesh.can_collide) {
      if (!vertices_t0.allFinite() || !vertices_t1.allFinite()) return 0;
      Candidates all;
      all.build(mesh, vertices_t0, vertices_t1, in_environment([&] { return min_distance / 2; }),
                broad_phase);
      return all.compute_collision_free_stepsize(mesh, vertices_t0, vertices_t1, min_distance, ccd);
    }
    const Options options = options_of(min_distance, ccd);
    const ClosePairs close = close_pairs(mesh.onset_mesh(), vertices_t0, dhat, options);
    if (close.outcome != Outcome::free) return 0;
    return onset::compute_cfl_stepsize(mesh.onset_mesh(), vertices_t0, vertices_t1, close, options,
                                       in_environment([&] { return 1 - ccd.conservative_rescaling; }))
        .step;
  }
  bool is_step_collision_free(const CollisionMesh& mesh, const Eigen::MatrixXd& vertices_t0,
                              const Eigen::MatrixXd& vertices_t1, double min_distance = 0,
                              const NarrowPhaseCCD& ccd = DEFAULT_NARROW_PHASE_CCD) const {
    const StepResult r = onset::compute_collision_free_stepsize(mesh.onset_mesh(), list(mesh), vertices_t0,
                                                                vertices_t1, options_of(min_distance, ccd));
    return r.toi > 1;  // of the exact motion; 0 where the call found out nothing
  }

 private:
  onset::Candidates list(const CollisionMesh& mesh) const {
    const std::vector<int>& codim = mesh.codim_vertices();
    const auto edge_of = [&](int vertex) {
      const auto place = std::lower_bound(codim.begin(), codim.end(), vertex);
      if (place == codim.end() || *place != vertex)
        throw std::invalid_argument("vertex " + std::to_string(vertex) + " is none of codim_vertices");
      return int(mesh.num_edges()) + int(place - codim.begin());
    };
    onset::Candidates c;
    for (const PlaneVertexCandidate& p : pv_candidates) c.vertex_plane.push_back({p.vertex_id, p.plane_id});
    if (mesh.dim() == 2) {
      for (const VertexVertexCandidate& p : vv_candidates)
        c.vertex_edge.push_back({p.vertex0_id, edge_of(p.vertex1_id)});
      for (const EdgeVertexCandidate& p : ev_candidates) c.vertex_edge.push_back({p.vertex_id, p.edge_id});
      if (!ee_candidates.empty() || !fv_candidates.empty())
        throw std::invalid_argument("edge-edge and face-vertex candidates have no place in two dimensions");
      return c;
    }
    for (const VertexVertexCandidate& p : vv_candidates)
      c.edge_edge.push_back({edge_of(p.vertex0_id), edge_of(p.vertex1_id)});
    for (const EdgeVertexCandidate& p : ev_candidates)
      c.edge_edge.push_back({p.edge_id, edge_of(p.vertex_id)});
    for (const FaceVertexCandidate& p : fv_candidates) c.vertex_face.push_back({p.vertex_id, p.face_id});
    for (const EdgeEdgeCandidate& p : ee_candidates) c.edge_edge.push_back({p.edge0_id, p.edge1_id});
    return c;
  }
};

// Computes a step in [0, 1] from vertices_t0 towards vertices_t1 that is free of contact and leaves room for
// the next one (conservative_rescaling).
//
// Guarantee: no pair comes as close as min_distance, along the exact motion x0 + s dx, s in [0, step], and as
// the end of that is stored, with dx = vertices_t1 - vertices_t0 rounded to doubles (vertices_t1 itself,
// where can_collide is set). NaN and infinities: 0.
//
// vertices_t0, vertices_t1: #V x dim, surface positions; vertices_t0 is assumed to be free of intersections.
// min_distance: model length, >= 0.
// Throws std::invalid_argument for a wrong number of rows, and for min_distance and values of `ccd` out of
// range.
// Safe to call concurrently on one mesh where can_collide is.
inline double compute_collision_free_stepsize(const CollisionMesh& mesh, const Eigen::MatrixXd& vertices_t0,
                                              const Eigen::MatrixXd& vertices_t1, double min_distance = 0,
                                              const BroadPhase* broad_phase = nullptr,
                                              const NarrowPhaseCCD& ccd = DEFAULT_NARROW_PHASE_CCD) {
  mesh.require_surface(vertices_t0), mesh.require_surface(vertices_t1);
  return in_environment([&]() -> double {
    if (!vertices_t0.allFinite() || !vertices_t1.allFinite()) return 0;
    if (mesh.can_collide) {
      Candidates candidates;
      candidates.build(mesh, vertices_t0, vertices_t1, min_distance / 2, broad_phase);
      return candidates.compute_collision_free_stepsize(mesh, vertices_t0, vertices_t1, min_distance, ccd);
    }
    LineSearchOptions options = options_of(min_distance, ccd);
    options.gap_share = 1 - ccd.conservative_rescaling;
    return LineSearch(mesh.onset_mesh(), vertices_t0, Eigen::MatrixXd(vertices_t1 - vertices_t0), options)
        .largest_step()
        .step;
  });
}

// Tells, exactly, whether an edge and a face (in two dimensions two edges) without a common vertex have a
// common point, a touch is one, or a vertex is on a plane or behind it.
// Also true for NaN.
//
// Parameters, errors, thread safety: as compute_collision_free_stepsize.
inline bool has_intersections(const CollisionMesh& mesh, const Eigen::MatrixXd& vertices,
                              const BroadPhase* = nullptr) {
  const onset::Mesh& all = mesh.onset_mesh();
  if (!mesh.can_collide) return onset::has_intersections(all, vertices);
  const Intersections found = intersections(all, vertices);
  const auto may = [&](const Intersection& p) {
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = 2; j < 5; ++j)
        if (mesh.can_collide(std::size_t(p.vertices[i]), std::size_t(p.vertices[j]))) return true;
    return false;
  };
  return found.outcome != Outcome::free || !found.behind_planes.empty() ||
         std::any_of(found.begin(), found.end(), may);
}

// Tells whether the whole exact motion is certified free of contact. False also where that is not known.
//
// Parameters, errors, thread safety: as compute_collision_free_stepsize.
inline bool is_step_collision_free(const CollisionMesh& mesh, const Eigen::MatrixXd& vertices_t0,
                                   const Eigen::MatrixXd& vertices_t1, double min_distance = 0,
                                   const BroadPhase* broad_phase = nullptr,
                                   const NarrowPhaseCCD& ccd = DEFAULT_NARROW_PHASE_CCD) {
  mesh.require_surface(vertices_t0), mesh.require_surface(vertices_t1);
  return in_environment([&]() -> bool {
    if (!mesh.can_collide)
      return onset::is_step_collision_free(mesh.onset_mesh(), vertices_t0, vertices_t1,
                                           options_of(min_distance, ccd));
    if (!vertices_t0.allFinite() || !vertices_t1.allFinite()) return false;
    Candidates candidates;
    candidates.build(mesh, vertices_t0, vertices_t1, min_distance / 2, broad_phase);
    return candidates.is_step_collision_free(mesh, vertices_t0, vertices_t1, min_distance, ccd);
  });
}

}  // namespace onset::ipc
