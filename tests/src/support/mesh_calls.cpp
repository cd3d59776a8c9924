#include <utility>

#include "tests/src/support/call_parts.hpp"

namespace onset::tests {
namespace {

void add_mesh(const Mesh& mesh, Answer& a) {
  a.add(mesh.num_vertices(), mesh.num_edges(), mesh.num_faces(), mesh.num_points(), mesh.num_bodies(),
        mesh.num_full_vertices());
  for (int e = 0; e < mesh.num_edges(); ++e) a.add(mesh.edge(e));
  for (int f = 0; f < mesh.num_faces(); ++f) a.add(mesh.face(f));
  for (int v = 0; v < mesh.num_vertices(); ++v) a.add(mesh.body(v), mesh.full_vertex(v));
  a.add(mesh.rules(), mesh.filter_counts(), mesh.components());
}

}  // namespace

void ask_mesh(const Mesh& mesh, const Subject& s, const Options&, Answer& a) {
  const Eigen::MatrixXd& x = s.scene.x_t0;
  const Eigen::MatrixXi& F = s.scene.faces;
  Mesh empty, copy = mesh;
  copy.set_rules({});
  empty = copy;
  Mesh moved = std::move(empty);
  copy.set_rules(s.rules);
  std::vector<int> ids;
  for (int v = 0; v < mesh.num_vertices(); ++v) ids.push_back(2 * v);
  copy.set_full_vertices(ids, 2 * mesh.num_vertices());
  mesh.release_memory();
  add_mesh(mesh, a), add_mesh(empty, a), add_mesh(moved, a), add_mesh(copy, a);
  add_mesh(Mesh(x, edges(F), F), a);
  add_mesh(Mesh(x.rows(), complete_edges(edges(F).topRows(2), F), F, s.rules), a);
  add_mesh(Mesh(x.rows(), F), a);
  a.add(edge_list(F), complete_edge_list(edges(F).topRows(3), F), edge_matrix({{1, 2}, {3, 4}}));
  a.add(mesh.of_bodies(std::vector<double>(std::size_t(mesh.num_bodies()), 0.5)));
  for (const Contact& contact : s.set) a.add(copy.full_vertices(contact), copy.full_dofs(contact));
  Eigen::MatrixXd full(2 * x.rows(), 3);
  full << x, x;
  a.add(copy.surface_positions(full));
  a.add(&copy.data() == &mesh.data());
}

void ask_words(const Mesh& mesh, const Subject& s, const Options&, Answer& a) {
  for (int i = 0; i < 16; ++i)
    a.add(to_string(PairKind(i)), to_string(PairOutcome(i)), to_string(Outcome(i)), to_string(Certainty(i)),
          to_string(IntersectionKind(i)), to_string(StartFault(i)));
  const FilterCounts& counts = mesh.filter_counts();
  a.add(counts.vertex_face.may_meet(), counts.edge_edge.may_meet());
  const Positions view(s.scene.x_t0), packed(s.scene.x_t0.data(), s.scene.x_t0.rows());
  a.add(view.rows(), view.cols(), view(0, 1), view.row_stride(), view.col_stride(), *view.data(),
        packed.rows(), packed(1, 0));
  const Indices ids(s.scene.faces);
  a.add(ids.rows(), ids.cols(), ids(0, 2), Indices().rows());
}

}  // namespace onset::tests
