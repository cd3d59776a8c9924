#include <onset/compat/ipc.hpp>

#include "tests/src/support/call_parts.hpp"

namespace onset::tests {
namespace {

// A mesh of twice as many vertices, of which every second one is of the surface.
Eigen::MatrixXd full_positions(const Subject& s) {
  const Eigen::Index n = s.scene.x_t0.rows();
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(2 * n, 3);
  for (Eigen::Index v = 0; v < n; ++v) full.row(2 * v + 1) = s.scene.x_t0.row(v);
  return full;
}
ipc::CollisionMesh surface_of(const Subject& s, const Eigen::MatrixXd& full) {
  const Eigen::MatrixXi F = (2 * s.scene.faces.array() + 1).matrix();
  return ipc::CollisionMesh::build_from_full_mesh(full, edges(F), F);
}

Eigen::SparseMatrix<double> identity(Eigen::Index size) {
  Eigen::SparseMatrix<double> m(size, size);
  m.setIdentity();
  return m;
}

// x - x is -0 where the host rounds downward.
Eigen::MatrixXd unsigned_zeros(const Eigen::MatrixXd& m) {
  return m.unaryExpr([](double x) { return x == 0 ? 0 : x; });
}

void add_candidates(const ipc::Candidates& c, Answer& a) {
  a.add(c.size(), c.empty());
  for (const auto& p : c.vv_candidates) a.add(p.vertex0_id, p.vertex1_id);
  for (const auto& p : c.ev_candidates) a.add(p.edge_id, p.vertex_id);
  for (const auto& p : c.ee_candidates) a.add(p.edge0_id, p.edge1_id);
  for (const auto& p : c.fv_candidates) a.add(p.face_id, p.vertex_id);
  for (const auto& p : c.pv_candidates) a.add(p.plane.offset(), p.vertex_id);
}

}  // namespace

// Maps are the host's arithmetic, in whatever way it rounds: here all that they compute is exact.
void ask_surfaces(const Mesh&, const Subject& s, const Options&, Answer& a) {
  const Eigen::MatrixXd &x = s.scene.x_t0, more = full_positions(s);
  const auto add = [&](const ipc::CollisionMesh& mesh, const Eigen::MatrixXd& full) {
    a.add(mesh.rest_positions(), mesh.edges(), mesh.faces(), mesh.num_vertices(), mesh.num_edges(),
          mesh.num_faces(), mesh.codim_vertices(), mesh.num_codim_vertices(), mesh.ndof(),
          mesh.full_num_vertices(), mesh.full_ndof(), mesh.dim(), mesh.to_full_vertex_id(1));
    const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(full.rows(), 3);
    a.add(unsigned_zeros(mesh.vertices(full)), unsigned_zeros(mesh.displace_vertices(none)),
          unsigned_zeros(mesh.map_displacements(full)));
    a.add(mesh.to_full_dof(Eigen::VectorXd(Eigen::VectorXd::Ones(Eigen::Index(mesh.ndof())))));
    a.add(Eigen::MatrixXd(mesh.to_full_dof(identity(Eigen::Index(mesh.ndof()))).diagonal()));
    mesh.require_surface(mesh.rest_positions());
    a.add(mesh.onset_mesh().num_edges());
  };
  add(surface_of(s, more), more);
  add(ipc::CollisionMesh(x, edges(s.scene.faces), s.scene.faces, identity(x.rows())), x);
}

// Twice: all vertices may collide, and only those with an odd sum of ids.
void ask_adapter(const Mesh&, const Subject& s, const Options&, Answer& a) {
  const Eigen::MatrixXd &x_t0 = s.scene.x_t0, &x_t1 = s.scene.x_t1;
  ipc::CollisionMesh mesh(x_t0, edges(s.scene.faces), s.scene.faces);
  mesh.set_planes(s.rules.planes);
  const ipc::TightInclusionCCD ccd = ipc::DEFAULT_NARROW_PHASE_CCD;
  a.add(ipc::options_of(0.5, ccd).min_separation, ipc::in_environment([&] { return s.d_hat / 3; }));
  for (const bool filtered : {false, true}) {
    if (filtered) mesh.can_collide = [](std::size_t i, std::size_t j) { return (i + j) % 2 == 1; };
    a.add(ipc::compute_collision_free_stepsize(mesh, x_t0, x_t1), ipc::has_intersections(mesh, x_t1),
          ipc::is_step_collision_free(mesh, x_t0, x_t1));
    ipc::Candidates candidates;
    candidates.build(mesh, x_t0, 0.5 * s.d_hat);
    add_candidates(candidates, a);
    candidates.build(mesh, x_t0, x_t1);
    add_candidates(candidates, a);
    a.add(candidates.compute_collision_free_stepsize(mesh, x_t0, x_t1),
          candidates.is_step_collision_free(mesh, x_t0, x_t1));
    a.add(candidates.compute_cfl_stepsize(mesh, x_t0, x_t1, s.d_hat));
    a.add(candidates.compute_noncandidate_conservative_stepsize(mesh, x_t0, s.d_hat),
          candidates.compute_per_vertex_safe_distances(mesh, x_t0, s.d_hat, 0.25 * s.d_hat));
    for (std::size_t i = 0; i < candidates.size(); i += 1 + candidates.size() / 8) {
      const ipc::CollisionStencil& pair = candidates[i];
      double toi = -1;
      a.add(pair.ccd(pair.dof(x_t0, mesh.edges(), mesh.faces()), pair.dof(x_t1, mesh.edges(), mesh.faces()),
                     toi, 0.125 * s.d_hat, 0.75, ipc::AdditiveCCD()));
      a.add(toi, pair.compute_coefficients(x_t0, mesh.edges(), mesh.faces()));
    }
    const ipc::SweepAndPrune broad_phase;
    a.add(ipc::compute_collision_free_stepsize(mesh, x_t0, x_t1, 0, &broad_phase, ipc::AdditiveCCD()));
    candidates.clear();
  }
}

}  // namespace onset::tests
