// A tour of ipc-toolkit's collision detection, in the order of its tutorial (getting started, filters,
// planes). It compiles with either library: what differs is the headers and the namespace, below.
#ifdef ONSET_TOUR_OF_IPC_TOOLKIT
#include <ipc/broad_phase/brute_force.hpp>
#include <ipc/broad_phase/create_broad_phase.hpp>
#include <ipc/broad_phase/hash_grid.hpp>
#include <ipc/broad_phase/lbvh.hpp>
#include <ipc/broad_phase/spatial_hash.hpp>
#include <ipc/broad_phase/sweep_and_prune.hpp>
#include <ipc/candidates/candidates.hpp>
#include <ipc/ccd/additive_ccd.hpp>
#include <ipc/ccd/tight_inclusion_ccd.hpp>
#include <ipc/collision_filter.hpp>
#include <ipc/collision_mesh.hpp>
#include <ipc/ipc.hpp>
#else
#include <onset/compat/ipc.hpp>
namespace ipc = onset::ipc;
#endif

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

namespace {

int requirements = 0;
void require(bool holds, const char* what) {
  ++requirements;
  if (holds) return;
  std::fprintf(stderr, "not so: %s\n", what);
  std::exit(1);
}
#define REQUIRE(what) require(what, #what)

// A surface: positions, edges, faces.
struct Body {
  Eigen::MatrixXd rest_positions;
  Eigen::MatrixXi edges, faces;
};

// A square patch of n x n vertices at a height: faces, and each of their edges once.
Body patch(int n, double height) {
  Body b;
  b.rest_positions.resize(n * n, 3);
  b.edges.resize(2 * n * (n - 1) + (n - 1) * (n - 1), 2);
  b.faces.resize(2 * (n - 1) * (n - 1), 3);
  int e = 0, f = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const int v = n * i + j;
      b.rest_positions.row(v) << double(i) / (n - 1), height + 0.01 * ((i * j) % 3), double(j) / (n - 1);
      if (i + 1 < n) b.edges.row(e++) << v, v + n;
      if (j + 1 < n) b.edges.row(e++) << v, v + 1;
      if (i + 1 == n || j + 1 == n) continue;
      b.edges.row(e++) << v + 1, v + n;
      b.faces.row(f++) << v, v + 1, v + n;
      b.faces.row(f++) << v + 1, v + n + 1, v + n;
    }
  return b;
}

Body both(const Body& a, const Body& b) {
  Body r;
  const int n = int(a.rest_positions.rows());
  r.rest_positions.resize(n + b.rest_positions.rows(), 3);
  r.rest_positions << a.rest_positions, b.rest_positions;
  r.edges.resize(a.edges.rows() + b.edges.rows(), 2);
  r.edges << a.edges, b.edges.array() + n;
  r.faces.resize(a.faces.rows() + b.faces.rows(), 3);
  r.faces << a.faces, b.faces.array() + n;
  return r;
}

}  // namespace

int main() {
  // The collision mesh.
  const Body body = both(patch(5, 0.0), patch(5, 1.0));
  ipc::CollisionMesh collision_mesh;
  collision_mesh = ipc::CollisionMesh(body.rest_positions, body.edges, body.faces);
  REQUIRE(collision_mesh.num_vertices() == 50 && collision_mesh.num_faces() == 64);
  REQUIRE(collision_mesh.num_edges() == 112 && collision_mesh.dim() == 3 && collision_mesh.ndof() == 150);
  REQUIRE(collision_mesh.num_codim_vertices() == 0 && collision_mesh.codim_edges().size() == 0);
  REQUIRE(collision_mesh.faces_to_edges().rows() == 64);
  REQUIRE(collision_mesh.edges_to_faces()[0].size() == 1);
  REQUIRE(collision_mesh.are_adjacencies_initialized());
  REQUIRE(collision_mesh.vertex_vertex_adjacencies()[0].size() == 2);
  REQUIRE(collision_mesh.max_edge_length() < 0.4);

  // A collision-free step.
  const Eigen::MatrixXd vertices_t0 = collision_mesh.rest_positions();
  Eigen::MatrixXd vertices_t1 = vertices_t0;
  vertices_t1.bottomRows(25).col(1).array() -= 2;  // the upper patch falls through the lower one
  double max_step_size = ipc::compute_collision_free_stepsize(collision_mesh, vertices_t0, vertices_t1);
  REQUIRE(max_step_size > 0.35 && max_step_size < 0.5);
  Eigen::MatrixXd collision_free_vertices = (vertices_t1 - vertices_t0) * max_step_size + vertices_t0;
  REQUIRE(!ipc::is_step_collision_free(collision_mesh, vertices_t0, vertices_t1));
  REQUIRE(
      ipc::is_step_collision_free(collision_mesh, vertices_t0, (collision_free_vertices + vertices_t0) / 2));
  REQUIRE(!ipc::has_intersections(collision_mesh, collision_free_vertices));

  // With a minimum separation.
  const double apart = ipc::compute_collision_free_stepsize(collision_mesh, vertices_t0, vertices_t1,
                                                            /*min_distance=*/0.1);
  REQUIRE(apart < max_step_size && apart > 0.3);

  // The broad phase, by a pointer to one of several.
  ipc::LBVH broad_phase;
  ipc::Candidates candidates;
  candidates.build(collision_mesh, vertices_t0, vertices_t1, /*inflation_radius=*/0.0, &broad_phase);
  REQUIRE(!candidates.empty());
  const std::size_t count = candidates.size();
  const std::vector<std::shared_ptr<ipc::BroadPhase>> others{
      ipc::create_broad_phase(ipc::BroadPhaseMethod::BRUTE_FORCE), std::make_shared<ipc::HashGrid>(),
      std::make_shared<ipc::SpatialHash>(), std::make_shared<ipc::SweepAndPrune>()};
  for (const std::shared_ptr<ipc::BroadPhase>& other : others) {
    candidates.build(collision_mesh, vertices_t0, vertices_t1, 0.0, other.get());
    REQUIRE(candidates.size() <= count + 20 && !other->name().empty());
  }
  broad_phase.build(vertices_t0, vertices_t1, body.edges, body.faces);
  std::vector<ipc::EdgeEdgeCandidate> edge_edge;
  broad_phase.detect_edge_edge_candidates(edge_edge);
  REQUIRE(edge_edge.size() >= candidates.ee_candidates.size());
  broad_phase.clear();

  // What a candidate can be asked.
  double earliest = 1;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const auto& candidate = candidates[i];
    const auto ids = candidate.vertex_ids(collision_mesh.edges(), collision_mesh.faces());
    REQUIRE(ids[0] >= 0 && candidate.num_vertices() == 4);
    const auto x0 = candidate.dof(vertices_t0, collision_mesh.edges(), collision_mesh.faces());
    const auto x1 = candidate.dof(vertices_t1, collision_mesh.edges(), collision_mesh.faces());
    REQUIRE(candidate.compute_distance(x0) > 0 && x1.size() == 12);
    REQUIRE(candidates.is_edge_edge(i) || candidates.is_face_vertex(i));
    double toi = 1;
    if (candidate.ccd(x0, x1, toi, /*min_distance=*/0.0, /*tmax=*/1.0, ipc::AdditiveCCD()))
      earliest = std::min(earliest, toi);
  }
  REQUIRE(earliest > 0.35 && earliest < 0.5);
  for (const auto& [face_id, vertex_id] : candidates.fv_candidates) REQUIRE(face_id >= 0 && vertex_id >= 0);
  REQUIRE(candidates.compute_collision_free_stepsize(collision_mesh, vertices_t0, vertices_t1) < 0.5);
  REQUIRE(!candidates.is_step_collision_free(collision_mesh, vertices_t0, vertices_t1));

  // The narrow phase on its own.
  const Eigen::Vector3d p_t0(0, -1, 0), p_t1(0, 1, 0), t0(-1, 0, 1), t1(1, 0, 1), t2(0, 0, -1);
  const ipc::TightInclusionCCD narrow_phase(ipc::TightInclusionCCD::DEFAULT_TOLERANCE,
                                            ipc::TightInclusionCCD::DEFAULT_MAX_ITERATIONS,
                                            /*conservative_rescaling=*/1.0);
  double toi = 0;
  REQUIRE(narrow_phase.point_triangle_ccd(p_t0, t0, t1, t2, p_t1, t0, t1, t2, toi));
  REQUIRE(toi > 0.499 && toi <= 0.5);
  REQUIRE(!narrow_phase.point_triangle_ccd(p_t0, t0, t1, t2, p_t1, t0, t1, t2, toi, 0.0, /*tmax=*/0.25));
  REQUIRE(narrow_phase.edge_edge_ccd(p_t0, p_t0 + t1, t0, t1, p_t1, p_t1 + t1, t0, t1, toi));
  REQUIRE(narrow_phase.point_edge_ccd(p_t0, p_t1, t0, p_t1, p_t0, t0, toi));
  REQUIRE(narrow_phase.point_point_ccd(p_t0, p_t1, p_t1, p_t0, toi, /*min_distance=*/0.5));
  REQUIRE(toi > 0.374 && toi <= 0.375);
  REQUIRE(ipc::compute_collision_free_stepsize(collision_mesh, vertices_t0, vertices_t1, 0.0, &broad_phase,
                                               ipc::AdditiveCCD(/*max_iterations=*/1000, 0.9)) < 0.5);

  // Filters: by connected parts, static obstacles, patches, and a function.
  const ipc::CollisionFilter no_self = ipc::make_connected_components_filter(collision_mesh.faces());
  const ipc::CollisionFilter no_static = ipc::make_static_obstacle_filter(25);
  collision_mesh.can_collide = no_self & no_static;
  REQUIRE(collision_mesh.can_collide(0, 49) && !collision_mesh.can_collide(0, 1));
  REQUIRE(ipc::compute_collision_free_stepsize(collision_mesh, vertices_t0, vertices_t1) < 0.5);
  collision_mesh.can_collide = (!no_self) | (!no_static);
  REQUIRE(!collision_mesh.can_collide(0, 49));
  Eigen::VectorXi patch_ids = Eigen::VectorXi::Zero(50);
  patch_ids.tail(25).setOnes();
  collision_mesh.can_collide = ipc::make_vertex_patches_filter(patch_ids);
  REQUIRE(collision_mesh.can_collide(24, 25));
  collision_mesh.can_collide = [&](std::size_t vi, std::size_t vj) { return patch_ids[vi] == patch_ids[vj]; };
  REQUIRE(ipc::compute_collision_free_stepsize(collision_mesh, vertices_t0, vertices_t1) == 1);
  collision_mesh.can_collide = ipc::CollisionFilter();

  // A ground plane between the patches.
  collision_mesh.planes.emplace_back(Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, -0.25, 0));
  candidates.build(collision_mesh, vertices_t0, vertices_t1);
  REQUIRE(candidates.pv_candidates.size() == 25);
  REQUIRE(candidates.is_plane_vertex(candidates.size() - 1));
  collision_mesh.planes.clear();

  // Steps and distances that need no search for collisions.
  const double dhat = 0.05;
  candidates.build(collision_mesh, vertices_t0, /*inflation_radius=*/dhat / 2);
  const Eigen::MatrixXd displacements = vertices_t1 - vertices_t0;
  REQUIRE(candidates.compute_noncandidate_conservative_stepsize(collision_mesh, displacements, dhat) >= 0);
  REQUIRE(candidates.compute_cfl_stepsize(collision_mesh, vertices_t0, vertices_t1, dhat) > 0);
  const Eigen::VectorXd safe =
      candidates.compute_per_vertex_safe_distances(collision_mesh, vertices_t0, dhat, /*min_distance=*/0.0);
  REQUIRE(safe.size() == 50 && safe.maxCoeff() <= dhat);

  // The surface of a full mesh that has a vertex more.
  Eigen::MatrixXd full(51, 3);
  full << 0.5, 0.5, 0.5, body.rest_positions;
  const ipc::CollisionMesh surface =
      ipc::CollisionMesh::build_from_full_mesh(full, body.edges.array() + 1, body.faces.array() + 1);
  REQUIRE(surface.num_vertices() == 50 && surface.full_num_vertices() == 51);
  REQUIRE(surface.to_full_vertex_id(0) == 1);
  REQUIRE(surface.vertices(full) == body.rest_positions);
  REQUIRE(surface.displace_vertices(Eigen::MatrixXd::Zero(51, 3)) == body.rest_positions);
  const Eigen::VectorXd gradient = Eigen::VectorXd::Ones(150);
  REQUIRE(surface.to_full_dof(gradient).size() == 153);
  REQUIRE(surface.to_full_dof(Eigen::SparseMatrix<double>(150, 150)).rows() == 153);

  std::printf("%d requirements hold\n", requirements);
}
