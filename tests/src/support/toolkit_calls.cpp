// What the adapter for ipc-toolkit's calls has beside steps: broad phases, filters, queries, what a mesh
// knows of itself.
#include <onset/compat/ipc.hpp>

#include "tests/src/support/call_parts.hpp"

namespace onset::tests {
namespace {

template <class List, class Ids>
void add_list(const List& list, Answer& a, const Ids& ids) {
  a.add(list.size());
  for (const auto& p : list) {
    const auto [first, second] = ids(p);
    a.add(first, second);
  }
}

void add_detected(const ipc::BroadPhase& phase, Answer& a) {
  a.add(int(phase.onset_method()), phase.name().size());
  std::vector<ipc::VertexVertexCandidate> vv;
  std::vector<ipc::EdgeVertexCandidate> ev;
  std::vector<ipc::EdgeEdgeCandidate> ee;
  std::vector<ipc::FaceVertexCandidate> fv;
  std::vector<ipc::EdgeFaceCandidate> ef;
  std::vector<ipc::FaceFaceCandidate> ff;
  phase.detect_vertex_vertex_candidates(vv);
  phase.detect_edge_vertex_candidates(ev);
  phase.detect_edge_edge_candidates(ee);
  phase.detect_face_vertex_candidates(fv);
  phase.detect_edge_face_candidates(ef);
  phase.detect_face_face_candidates(ff);
  const auto pair = [](auto i, auto j) { return std::array<int, 2>{int(i), int(j)}; };
  add_list(vv, a, [&](const auto& p) { return pair(p.vertex0_id, p.vertex1_id); });
  add_list(ev, a, [&](const auto& p) { return pair(p.edge_id, p.vertex_id); });
  add_list(ee, a, [&](const auto& p) { return pair(p.edge0_id, p.edge1_id); });
  add_list(fv, a, [&](const auto& p) { return pair(p.face_id, p.vertex_id); });
  add_list(ef, a, [&](const auto& p) { return pair(p.edge_id, p.face_id); });
  add_list(ff, a, [&](const auto& p) { return pair(p.face0_id, p.face1_id); });
  ipc::Candidates all;
  phase.detect_collision_candidates(all);
  a.add(all.size());
}

void add_lists(const std::vector<std::vector<int>>& lists, Answer& a) {
  for (const std::vector<int>& list : lists) {
    a.add(list.size());
    for (const int id : list) a.add(id);
  }
}

void add_maps(ipc::CollisionMesh mesh, Answer& a) {
  mesh.init_adjacencies();
  a.add(mesh.are_adjacencies_initialized(), mesh.num_codim_edges(), mesh.codim_edges(),
        mesh.faces_to_edges());
  a.add(mesh.is_codim_vertex(0), mesh.is_codim_edge(0), mesh.is_orient_vertex(0));
  for (const auto* lists : {&mesh.edges_to_faces(), &mesh.vertices_to_edges(), &mesh.vertices_to_faces(),
                            &mesh.vertex_vertex_adjacencies(), &mesh.vertex_edge_adjacencies(),
                            &mesh.vertex_face_adjacencies(), &mesh.edge_vertex_adjacencies()})
    add_lists(*lists, a);
  a.add(mesh.edge_length(0), mesh.max_edge_length());
  a.add(ipc::CollisionMesh::construct_faces_to_edges(mesh.faces(), mesh.edges()));
  for (const bool on : ipc::CollisionMesh::construct_is_on_surface(mesh.num_vertices(), mesh.edges()))
    a.add(on);
  Eigen::SparseMatrix<double> one(1, 1);
  one.insert(0, 0) = 1;
  a.add(Eigen::MatrixXd(ipc::CollisionMesh::vertex_matrix_to_dof_matrix(one, 3)));
}

void add_filters(const Subject& s, Answer& a) {
  const int ids[] = {0, 1, 2};
  const Eigen::VectorXi patches =
      Eigen::VectorXi::LinSpaced(s.scene.x_t0.rows(), 0, int(s.scene.x_t0.rows()) - 1);
  for (const ipc::CollisionFilter& may :
       {ipc::make_vertex_patches_filter(patches), ipc::make_static_obstacle_filter(1),
        ipc::make_codim_cross_filter(1), ipc::make_connected_components_filter(s.scene.faces)})
    a.add(ipc::may_collide(may, ids, 1, ids + 1, 2), may(0, 1), (!may)(0, 2), (may & !may)(1, 2),
          (may | !may).accepts_all());
}

void add_queries(const Subject& s, Answer& a) {
  const auto x0 = [&](int v) { return Eigen::Vector3d(s.scene.x_t0.row(v)); };
  const auto x1 = [&](int v) { return Eigen::Vector3d(s.scene.x_t1.row(v)); };
  for (const ipc::NarrowPhaseCCD* ccd :
       {static_cast<const ipc::NarrowPhaseCCD*>(&ipc::DEFAULT_NARROW_PHASE_CCD)}) {
    a.add(ccd->onset_options().has_value(), ipc::DEFAULT_NARROW_PHASE_CCD.options().max_checks);
    double toi = -1;
    a.add(ccd->point_point_ccd(x0(0), x0(1), x1(0), x1(1), toi), toi);
    a.add(ccd->point_edge_ccd(x0(0), x0(1), x0(2), x1(0), x1(1), x1(2), toi), toi);
    a.add(ccd->point_triangle_ccd(x0(3), x0(0), x0(1), x0(2), x1(3), x1(0), x1(1), x1(2), toi, s.d_hat), toi);
    a.add(ccd->edge_edge_ccd(x0(0), x0(1), x0(2), x0(3), x1(0), x1(1), x1(2), x1(3), toi), toi);
  }
}

void add_stencils(const ipc::CollisionMesh& mesh, const Subject& s, Answer& a) {
  ipc::Candidates all;
  a.add(all.build_if_finite(mesh, s.scene.x_t0, s.scene.x_t1, s.d_hat, nullptr));
  for (std::size_t i = 0; i < all.size(); i += 1 + all.size() / 8) {
    a.add(all.is_vertex_vertex(i), all.is_edge_vertex(i), all.is_edge_edge(i), all.is_face_vertex(i),
          all.is_plane_vertex(i));
    const ipc::CollisionStencil& pair = all[i];
    for (const auto v : pair.vertex_ids(mesh.edges(), mesh.faces())) a.add(v);
    a.add(pair.compute_distance(s.scene.x_t0, mesh.edges(), mesh.faces()));
    if (all.is_edge_edge(i)) a.add(pair.as<ipc::EdgeEdgeCandidate>().edge0_id);
  }
}

}  // namespace

void ask_toolkit(const Mesh&, const Subject& s, const Options&, Answer& a) {
  const ipc::CollisionMesh mesh(s.scene.x_t0, edges(s.scene.faces), s.scene.faces);
  const auto ask = [&](ipc::BroadPhase& phase) {
    phase.build(s.scene.x_t0, s.scene.x_t1, mesh.edges(), mesh.faces(), 0.25 * s.d_hat);
    add_detected(phase, a);
    phase.clear();
  };
  ask(*ipc::make_default_broad_phase());
  ask(*ipc::create_broad_phase(ipc::BroadPhaseMethod::HASH_GRID));
  add_maps(mesh, a);
  add_filters(s, a);
  add_queries(s, a);
  add_stencils(mesh, s, a);
}

}  // namespace onset::tests
