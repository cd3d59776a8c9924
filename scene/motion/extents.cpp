#include "scene/motion/extents.hpp"

#include <cmath>

#include "scene/pairs/whole_scene.hpp"

namespace onset {

double Extents::largest() const {
  double r = 0;
  for (int a = 0; a < 3; ++a) r = std::max(r, largest(a));
  return r;
}
double Extents::largest(int a) const { return std::max({vertex_face[a], edge_edge[a], vertex_edge[a]}); }

Extents corner_extents(const MeshData& mesh, const Motion& m, double gap) {
  Extents r;
  const PrimitiveFilter& filter = *mesh.filter;
  const auto listed = [&](Primitive kind) {
    return filter.all ? nullptr : &filter.moving[std::size_t(kind)];
  };
  auto edge = largest_swept(mesh.edges, listed(Primitive::edge), m);
  auto face = largest_swept(mesh.faces, listed(Primitive::face), m);
  if (filter.has_static()) {
    const auto still = m.static_part ? m.static_part : make_static_motion(mesh, m);
    for (int a = 0; a < 3; ++a) {
      edge[a] = std::max(edge[a], still->widest_edge[m.axes[a]]);
      face[a] = std::max(face[a], still->widest_face[m.axes[a]]);
    }
  }
  std::array<double, 3> moved{};
  const std::size_t vertices = filter.all ? std::size_t(m.num_vertices) : filter.moving_vertices.size();
  for (std::size_t i = 0; i < vertices; ++i) {
    const int v = filter.all ? int(i) : filter.moving_vertices[i];
    for (int a = 0; a < 3; ++a) moved[a] = std::max(moved[a], std::fabs(m.t1(v)[a] - m.t0(v)[a]));
  }
  bool has_faces = !mesh.faces.empty(), has_edges = !mesh.edges.empty();
  if (const WholeScene* whole = mesh.whole.get()) {
    has_faces = whole->has_faces, has_edges = whole->has_edges;
    for (std::size_t a = 0; a < 3; ++a) {
      edge[a] = std::max(edge[a], whole->widest_edge[a]), face[a] = std::max(face[a], whole->widest_face[a]);
      moved[a] = std::max(moved[a], whole->moved[a]);
    }
  }
  for (int a = 0; a < 3; ++a) {  // each sum rounds twice: factor 1 + 4u
    if (has_faces) r.vertex_face[a] = (moved[a] * (1 + 0x1p-52) + face[a] + gap) * (1 + 0x1p-51);
    if (mesh.dimension == 2)
      r.vertex_edge[a] = (moved[a] * (1 + 0x1p-52) + edge[a] + gap) * (1 + 0x1p-51);
    else if (has_edges)
      r.edge_edge[a] = (2 * edge[a] + gap) * (1 + 0x1p-51);
  }
  return r;
}

}  // namespace onset
