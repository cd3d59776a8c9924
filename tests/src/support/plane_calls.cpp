#include "tests/src/support/call_parts.hpp"

namespace onset::tests {
namespace {

// The subject's scene without z; its rules are for faces.
struct Flat {
  Eigen::MatrixXd x_t0, x_t1;
  Mesh mesh;
  explicit Flat(const Subject& s)
      : x_t0(s.scene.x_t0.leftCols(2)),
        x_t1(s.scene.x_t1.leftCols(2)),
        mesh(Mesh::in_plane(x_t0.rows(), edges(s.scene.faces))) {}
};

}  // namespace

void ask_plane_step(const Mesh&, const Subject& s, const Options& o, Answer& a) {
  const Flat flat(s);
  a.add(compute_collision_free_stepsize(flat.mesh, flat.x_t0, flat.x_t1, o));
}
void ask_plane_set(const Mesh&, const Subject& s, const Options& o, Answer& a) {
  const Flat flat(s);
  a.add(construct_active_set(flat.mesh, flat.x_t0, flat.x_t1, o));
}
void ask_plane_start(const Mesh&, const Subject& s, const Options& o, Answer& a) {
  const Flat flat(s);
  a.add(intersections(flat.mesh, flat.x_t0, o));
  a.add(check(flat.mesh, flat.x_t0, o));
}

void ask_plane_pairs(const Mesh&, const Subject& s, const Options&, Answer& a) {
  const Flat flat(s);
  a.add(flat.mesh.dimension(), Positions(flat.x_t0).in_space()(0, 2), flat.mesh.filter_counts());
  const ActiveSet set = construct_active_set(flat.mesh, flat.x_t0, flat.x_t1);
  a.add(assemble_constraints(set));
  const auto points = [](const Eigen::MatrixXd& x, const Contact& c) {
    std::array<PlanePoint, 3> p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = {x(c.vertices[i], 0), x(c.vertices[i], 1)};
    return p;
  };
  for (std::size_t i = 0; i < set.size(); i += 1 + set.size() / 20) {
    a.add(flat.mesh.full_dofs(set[i]));
    a.add(vertex_edge_ccd({points(flat.x_t0, set[i]), points(flat.x_t1, set[i])}));
  }
}

}  // namespace onset::tests
