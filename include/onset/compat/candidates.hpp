// The Candidates of onset/compat/ipc.hpp, which includes this: pairs found once, and the questions that are
// asked about them.
//
// Source: ipc::Candidates of ipc-toolkit (https://github.com/ipc-sim/ipc-toolkit), whose names it has.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <onset/candidates.hpp>
#include <onset/close_pairs.hpp>
#include <onset/compat/broad_phase.hpp>
#include <onset/compat/collision_mesh.hpp>
#include <onset/compat/narrow_phase.hpp>
#include <onset/compat/stencils.hpp>
#include <onset/safe_distance.hpp>
#include <onset/step_size.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace onset::ipc {

// f() in the library's floating-point environment: what these calls compute themselves is the same bytes
// whatever the host has set.
template <class F>
auto in_environment(const F& f) {
  decltype(f()) result{};
  in_default_float_environment([&] { result = f(); });
  return result;
}

// Makes Options of what ipc-toolkit passes.
inline Options options_of(double min_distance, const NarrowPhaseCCD& ccd,
                          const BroadPhase* broad_phase = nullptr) {
  Options o = ccd.onset_options().value_or(Options());
  o.min_separation = min_distance;
  if (broad_phase != nullptr) o.broad_phase = broad_phase->onset_method();
  return o;
}

// Whether a filter lets any pair of vertices of two primitives collide.
inline bool may_collide(const CollisionFilter& may, const int* first, int firsts, const int* second,
                        int seconds) {
  for (int i = 0; i < firsts; ++i)
    for (int j = 0; j < seconds; ++j)
      if (may(std::size_t(first[i]), std::size_t(second[j]))) return true;
  return false;
}

// Pairs whose boxes meet during a motion, less those that can_collide leaves out: data, each list sorted. The
// free functions of onset/compat/ipc.hpp do not need it. Const calls are safe from several threads.
class Candidates {
 public:
  // Of two codim_vertices.
  std::vector<VertexVertexCandidate> vv_candidates;
  // Of one of them and any edge; in two dimensions of any vertex.
  std::vector<EdgeVertexCandidate> ev_candidates;
  std::vector<EdgeEdgeCandidate> ee_candidates;
  std::vector<FaceVertexCandidate> fv_candidates;
  // Of CollisionMesh::planes, by vertex, then by plane.
  std::vector<PlaneVertexCandidate> pv_candidates;

  // Finds all pairs whose boxes, each wider by inflation_radius (model length, >= 0), meet during the motion.
  // vertices_t0, vertices_t1: surface positions, the two ends of the motion; one: where they stand.
  // broad_phase: only its kind is used; none is the default. Its filter is not asked, and it gets no boxes.
  // Throws std::runtime_error for NaN, infinities and |x| > 2^1020, std::invalid_argument for a wrong number
  // of rows.
  void build(const CollisionMesh& mesh, const Vertices& vertices_t0, const Vertices& vertices_t1,
             double inflation_radius = 0, const BroadPhase* broad_phase = nullptr) {
    clear();
    Options o = options_of(0, DEFAULT_NARROW_PHASE_CCD, broad_phase);
    // Each box is widened by half of it.
    o.min_separation = in_environment([&] { return 2 * inflation_radius; });
    const onset::Mesh all = mesh.onset_mesh();
    const onset::Candidates found = compute_candidates(all, *vertices_t0, *vertices_t1, o);
    if (found.outcome != Outcome::free)
      throw std::runtime_error(std::string("Candidates::build: ") + to_string(found.outcome));
    take(mesh, all, found);
  }
  void build(const CollisionMesh& mesh, const Vertices& vertices, double inflation_radius = 0,
             const BroadPhase* broad_phase = nullptr) {
    build(mesh, vertices, vertices, inflation_radius, broad_phase);
  }

  std::size_t size() const {
    return vv_candidates.size() + ev_candidates.size() + ee_candidates.size() + fv_candidates.size() +
           pv_candidates.size();
  }
  bool empty() const { return size() == 0; }
  void clear() { *this = {}; }

  // The i-th of all: those of two vertices, of edge and vertex, of two edges, of face and vertex, of plane
  // and vertex. Throws std::out_of_range.
  const CollisionStencil& operator[](std::size_t i) const {
    const CollisionStencil* found = nullptr;
    for_each_list([&](const auto& list) {
      if (found == nullptr && i < list.size()) found = &list[i];
      i -= std::min(i, list.size());
    });
    if (found == nullptr) throw std::out_of_range("Candidates: there is no such candidate");
    return *found;
  }
  CollisionStencil& operator[](std::size_t i) {
    return const_cast<CollisionStencil&>(static_cast<const Candidates&>(*this)[i]);
  }
  bool is_vertex_vertex(std::size_t i) const { return in_list(i, 0); }
  bool is_edge_vertex(std::size_t i) const { return in_list(i, 1); }
  bool is_edge_edge(std::size_t i) const { return in_list(i, 2); }
  bool is_face_vertex(std::size_t i) const { return in_list(i, 3); }
  bool is_plane_vertex(std::size_t i) const { return in_list(i, 4); }

  // As the free functions of these names (onset/compat/ipc.hpp), for these pairs alone. Throws
  // std::invalid_argument for ids that the mesh does not have; NaN, infinities, |x| > 2^1020 give 0 and
  // false.
  double compute_collision_free_stepsize(const CollisionMesh& mesh, const Vertices& vertices_t0,
                                         const Vertices& vertices_t1, double min_distance = 0,
                                         const NarrowPhaseCCD& ccd = DEFAULT_NARROW_PHASE_CCD) const {
    if (!ccd.onset_options()) return step_by(ccd, mesh, *vertices_t0, *vertices_t1, min_distance);
    return onset::compute_collision_free_stepsize(mesh.onset_mesh(), list(mesh), *vertices_t0, *vertices_t1,
                                                  options_of(min_distance, ccd),
                                                  compat::kept_share(ccd.conservative_rescaling))
        .step;
  }
  bool is_step_collision_free(const CollisionMesh& mesh, const Vertices& vertices_t0,
                              const Vertices& vertices_t1, double min_distance = 0,
                              const NarrowPhaseCCD& ccd = DEFAULT_NARROW_PHASE_CCD) const {
    if (!ccd.onset_options())
      return usable(*vertices_t0) && usable(*vertices_t1) &&
             !first_impact(ccd, mesh, *vertices_t0, *vertices_t1, min_distance, nullptr);
    const StepResult r = onset::compute_collision_free_stepsize(mesh.onset_mesh(), list(mesh), *vertices_t0,
                                                                *vertices_t1, options_of(min_distance, ccd));
    return r.toi > 1;  // of the exact motion; 0 where the call found out nothing
  }

  // Computes the largest step s in [0, 1] by which no vertex moves farther than dhat / 2 (model length, >=
  // 0), rounded down: any two primitives that are farther apart than dhat stay apart on the exact motion.
  // displacements: #V x dim; of all vertices, not of those of candidates, as ipc-toolkit 1.6.1 has it.
  double compute_noncandidate_conservative_stepsize(const CollisionMesh& mesh, const Vertices& displacements,
                                                    double dhat) const {
    mesh.require_surface(*displacements);
    if (!(dhat >= 0)) throw std::invalid_argument("dhat is " + std::to_string(dhat));
    const double half = in_environment([&] {
      const double r = dhat / 2;  // rounds where dhat is subnormal
      return 2 * r > dhat ? std::nextafter(r, 0.0) : r;
    });
    return safe_step(std::vector<double>(mesh.num_vertices(), half), in_space(*displacements));
  }

  // Computes a step that is free of contact as a whole, not for the pairs listed alone, from those that are
  // within dhat (model length, > 0) of their distance at vertices_t0 and a bound for all others. Every pair
  // keeps its share of its gap, of dhat where it is farther apart, so that the next step is not 0. Where
  // can_collide is set, or the narrow phase is not Onset's, the bound is not used: the step is that of all
  // pairs that may collide.
  double compute_cfl_stepsize(const CollisionMesh& mesh, const Vertices& vertices_t0,
                              const Vertices& vertices_t1, double dhat, double min_distance = 0,
                              const BroadPhase* broad_phase = nullptr,
                              const NarrowPhaseCCD& ccd = DEFAULT_NARROW_PHASE_CCD) const {
    mesh.require_surface(*vertices_t0), mesh.require_surface(*vertices_t1);
    if (!mesh.can_collide.accepts_all() || !ccd.onset_options()) {
      Candidates all;
      const double radius = in_environment([&] { return min_distance / 2; });
      if (!all.build_if_finite(mesh, vertices_t0, vertices_t1, radius, broad_phase)) return 0;
      return all.compute_collision_free_stepsize(mesh, vertices_t0, vertices_t1, min_distance, ccd);
    }
    const Options options = options_of(min_distance, ccd, broad_phase);
    const onset::Mesh all = mesh.onset_mesh();
    const ClosePairs close = close_pairs(all, *vertices_t0, dhat, options);
    if (close.outcome != Outcome::free) return 0;
    return onset::compute_cfl_stepsize(all, *vertices_t0, *vertices_t1, close, options,
                                       compat::kept_share(ccd.conservative_rescaling))
        .step;
  }

  // Computes how far each vertex may move, on any path (#V values, model length, >= 0): at most
  // inflation_radius - min_distance.
  //
  // Guarantee: while no vertex is farther from `vertices` than its value, no two primitives of the mesh that
  // may collide come as close as min_distance, also where all of them move, and as stored (onset/
  // safe_distance.hpp). This is at most half of the least gap of a vertex; ipc-toolkit 1.6.1 returns the
  // whole gap, which two vertices that move towards each other must share. It looks at all pairs of the mesh,
  // not at those listed here alone. Zeros where positions are NaN, infinite or beyond 2^1020.
  // Throws std::invalid_argument where inflation_radius < min_distance, or min_distance < 0.
  Eigen::VectorXd compute_per_vertex_safe_distances(const CollisionMesh& mesh, const Vertices& vertices,
                                                    double inflation_radius, double min_distance = 0) const {
    mesh.require_surface(*vertices);
    if (!(min_distance >= 0 && inflation_radius >= min_distance))
      throw std::invalid_argument("inflation_radius is " + std::to_string(inflation_radius) +
                                  ", min_distance " + std::to_string(min_distance));
    Eigen::VectorXd r = Eigen::VectorXd::Zero(Eigen::Index(mesh.num_vertices()));
    // Subtracted without an error, or rounded down; twice that is exact.
    const double most = in_environment([&] {
      const double d = inflation_radius - min_distance;
      const double below = inflation_radius - d < min_distance ? std::nextafter(d, 0.0) : d;  // exact
      return std::min(below, std::ldexp(1.0, 1019));  // close pairs are looked for up to 2^1020
    });
    if (!(most > 0) || r.size() == 0) return r;
    Options options;
    options.min_separation = min_distance;
    const onset::Mesh all = mesh.onset_mesh();
    ClosePairs close = close_pairs(all, *vertices, 2 * most, options);
    if (close.outcome != Outcome::free) return r;
    leave_out(mesh, close.pairs);
    const std::vector<double> safe = safe_distances(all, *vertices, close);
    for (Eigen::Index v = 0; v < r.size(); ++v) r[v] = std::min(most, safe[std::size_t(v)]);
    return r;
  }

  // As build, but returns whether positions are usable instead of throwing where they are not.
  bool build_if_finite(const CollisionMesh& mesh, const Vertices& vertices_t0, const Vertices& vertices_t1,
                       double inflation_radius, const BroadPhase* broad_phase) {
    if (!usable(*vertices_t0) || !usable(*vertices_t1)) return false;
    build(mesh, vertices_t0, vertices_t1, inflation_radius, broad_phase);
    return true;
  }

 private:
  template <class F>
  void for_each_list(F&& f) const {
    f(vv_candidates), f(ev_candidates), f(ee_candidates), f(fv_candidates), f(pv_candidates);
  }
  bool in_list(std::size_t i, int wanted) const {
    int n = 0, found = -1;
    for_each_list([&](const auto& list) {
      if (found < 0 && i < list.size()) found = n;
      i -= std::min(i, list.size());
      ++n;
    });
    return found == wanted;
  }

  void take(const CollisionMesh& mesh, const onset::Mesh& all, const onset::Candidates& found) {
    const CollisionFilter& can = mesh.can_collide;
    const int edges = int(mesh.num_edges());
    for (const auto& p : found.vertex_face)
      if (may_collide(can, &p[0], 1, all.face(p[1]).data(), 3)) fv_candidates.emplace_back(p[1], p[0]);
    for (const auto& p : found.vertex_plane) pv_candidates.emplace_back(mesh.planes[std::size_t(p[1])], p[0]);
    for (const auto& p : found.edge_edge) {
      const auto a = all.edge(p[0]), b = all.edge(p[1]);
      if (!may_collide(can, a.data(), 2, b.data(), 2)) continue;
      if (p[1] < edges)
        ee_candidates.emplace_back(p[0], p[1]);
      else if (p[0] < edges)
        ev_candidates.emplace_back(p[0], b[0]);
      else
        vv_candidates.emplace_back(a[0], b[0]);
    }
    for (const auto& [v, e] : found.vertex_edge) {
      const auto ends = all.edge(e);
      if (!may_collide(can, &v, 1, ends.data(), 2)) continue;
      if (e < edges)
        ev_candidates.emplace_back(e, v);
      else if (v < ends[0] && mesh.is_codim_vertex(v))
        vv_candidates.emplace_back(v, ends[0]);
    }
    std::sort(ev_candidates.begin(), ev_candidates.end());
    std::sort(fv_candidates.begin(), fv_candidates.end());
  }

  // Neither NaN nor beyond what Onset takes.
  static bool usable(const Eigen::MatrixXd& x) { return (x.array().abs() <= std::ldexp(1.0, 1020)).all(); }

  // Throws std::invalid_argument for a candidate of vertices, edges or faces that the mesh does not have.
  void require_ids(const CollisionMesh& mesh) const {
    const auto require = [](const char* what, auto id, std::size_t count) {
      if (id < 0 || std::size_t(id) >= count)
        throw std::invalid_argument(std::string(what) + " " + std::to_string(id) +
                                    " of a candidate is out of range, there are " + std::to_string(count));
    };
    const std::size_t vertices = mesh.num_vertices(), edges = mesh.num_edges(), faces = mesh.num_faces();
    for (const auto& p : vv_candidates)
      require("vertex", p.vertex0_id, vertices), require("vertex", p.vertex1_id, vertices);
    for (const auto& p : ev_candidates)
      require("edge", p.edge_id, edges), require("vertex", p.vertex_id, vertices);
    for (const auto& p : ee_candidates)
      require("edge", p.edge0_id, edges), require("edge", p.edge1_id, edges);
    for (const auto& p : fv_candidates)
      require("face", p.face_id, faces), require("vertex", p.vertex_id, vertices);
    for (const auto& p : pv_candidates) require("vertex", p.vertex_id, vertices);
  }

  // The smallest toi of a narrow phase that is not Onset's, asked for each pair; whether there is one.
  bool first_impact(const NarrowPhaseCCD& ccd, const CollisionMesh& mesh, const Eigen::MatrixXd& x0,
                    const Eigen::MatrixXd& x1, double min_distance, double* earliest) const {
    mesh.require_surface(x0), mesh.require_surface(x1);
    require_ids(mesh);
    bool any = false;
    for (std::size_t i = 0; i < size(); ++i) {
      const CollisionStencil& pair = (*this)[i];
      double toi = 0;
      if (!pair.ccd(pair.dof(x0, mesh.edges(), mesh.faces()), pair.dof(x1, mesh.edges(), mesh.faces()), toi,
                    min_distance, earliest != nullptr ? *earliest : 1, ccd))
        continue;
      any = true;
      if (earliest == nullptr) break;
      *earliest = std::min(*earliest, toi > 0 ? toi : 0);  // NaN is an impact, too
    }
    return any;
  }
  double step_by(const NarrowPhaseCCD& ccd, const CollisionMesh& mesh, const Eigen::MatrixXd& x0,
                 const Eigen::MatrixXd& x1, double min_distance) const {
    if (!usable(x0) || !usable(x1)) return 0;
    double earliest = 1;
    first_impact(ccd, mesh, x0, x1, min_distance, &earliest);
    return earliest;
  }

  // Leaves out the close pairs that may not collide.
  static void leave_out(const CollisionMesh& mesh, std::vector<ClosePair>& pairs) {
    if (mesh.can_collide.accepts_all()) return;
    const auto may_not = [&](const ClosePair& p) {
      if (p.kind == PairKind::vertex_plane) return false;
      const int first = p.kind == PairKind::edge_edge ? 2 : 1;
      return !may_collide(mesh.can_collide, p.vertices.data(), first, p.vertices.data() + first, 4 - first);
    };
    pairs.erase(std::remove_if(pairs.begin(), pairs.end(), may_not), pairs.end());
  }

  // safe_step takes three columns.
  static Eigen::MatrixXd in_space(const Eigen::MatrixXd& x) {
    Eigen::MatrixXd r = Eigen::MatrixXd::Zero(x.rows(), 3);
    r.leftCols(x.cols()) = x;
    return r;
  }

  onset::Candidates list(const CollisionMesh& mesh) const {
    require_ids(mesh);
    const Eigen::VectorXi& codim = mesh.codim_vertices();
    const int* const end = codim.data() + codim.size();
    const auto edge_of = [&](int vertex) {
      const int* const place = std::lower_bound(codim.data(), end, vertex);
      if (place == end || *place != vertex)
        throw std::invalid_argument("vertex " + std::to_string(vertex) + " is none of codim_vertices");
      return int(mesh.num_edges()) + int(place - codim.data());
    };
    onset::Candidates c;
    for (const PlaneVertexCandidate& p : pv_candidates)
      c.vertex_plane.push_back({p.vertex_id, plane_row(mesh, p.plane)});
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
  static int plane_row(const CollisionMesh& mesh, const Eigen::Hyperplane<double, 3>& plane) {
    for (std::size_t i = 0; i < mesh.planes.size(); ++i)
      if (mesh.planes[i].coeffs() == plane.coeffs()) return int(i);
    throw std::invalid_argument("the plane of a candidate is none of the mesh's planes");
  }
};

inline void BroadPhase::detect_collision_candidates(Candidates& candidates) const {
  candidates.clear();
  if (dim_ == 2) return detect_edge_vertex_candidates(candidates.ev_candidates);
  detect_edge_edge_candidates(candidates.ee_candidates);
  detect_face_vertex_candidates(candidates.fv_candidates);
}

}  // namespace onset::ipc
