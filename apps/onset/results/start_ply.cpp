#include <set>

#include "files/ply_output.hpp"
#include "onset/results/start_report.hpp"

namespace app {
namespace {

constexpr Colour kEdge{255, 0, 0}, kFace{255, 255, 0}, kTouching{0, 0, 255};

// Each element with corners of its own, for its colour.
struct StartLayer {
  struct Corner {
    int vertex;
    Colour colour;
  };
  std::vector<Corner> corners;
  std::vector<std::array<std::size_t, 2>> edges;
  std::vector<std::array<std::size_t, 3>> faces;

  std::size_t corner(int vertex, const Colour& colour) {
    corners.push_back({vertex, colour});
    return corners.size() - 1;
  }
  void edge(const std::array<int, 2>& v, const Colour& colour) {
    const std::size_t first = corner(v[0], colour);
    if (v[0] != v[1]) edges.push_back({first, corner(v[1], colour)});
  }
  void face(const std::array<int, 3>& v, const Colour& colour) {
    std::array<std::size_t, 3> own;
    for (std::size_t c = 0; c < 3; ++c) own[c] = corner(v[c], colour);
    faces.push_back(own);
  }
};

StartLayer make_layer(const onset::Mesh& mesh, const onset::StartReport& report) {
  StartLayer layer;
  std::set<int> edges, faces;
  for (const onset::Intersection& p : report.intersections) {
    if (edges.insert(p.edge).second) layer.edge(mesh.edge(p.edge), kEdge);
    if (mesh.dimension() == 2) {
      if (edges.insert(p.face).second) layer.edge(mesh.edge(p.face), kEdge);
    } else if (faces.insert(p.face).second) {
      layer.face(mesh.face(p.face), kFace);
    }
  }
  for (const onset::Pair& p : report.touching) {
    if (p.kind == onset::PairKind::vertex_plane) {
      layer.corner(p.a, kTouching);
      continue;
    }
    const bool vf = p.kind == onset::PairKind::vertex_face;
    if (vf) layer.corner(p.a, kTouching);
    if (vf && faces.insert(p.b).second) layer.face(mesh.face(p.b), kTouching);
    const bool ve = p.kind == onset::PairKind::vertex_edge;
    if (ve) layer.corner(p.a, kTouching);
    if (ve && edges.insert(p.b).second) layer.edge(mesh.edge(p.b), kTouching);
    if (p.kind == onset::PairKind::edge_edge)
      for (const int e : {p.a, p.b})
        if (edges.insert(e).second) layer.edge(mesh.edge(e), kTouching);
  }
  return layer;
}

}  // namespace

void write_start_ply(Output& file, const Scene& scene, const onset::StartReport& report) {
  const StartLayer layer = make_layer(scene.mesh, report);
  write_ply_header(
      file, {{"vertex",
              layer.corners.size(),
              {"double x", "double y", "double z", "uchar red", "uchar green", "uchar blue", "int id"}},
             ply_faces(layer.faces.size()),
             ply_edges(layer.edges.size())});
  for (const StartLayer::Corner& c : layer.corners) {
    const auto x = scene.x_t0.row(c.vertex);
    const auto [red, green, blue] = c.colour;
    file.write(format("%.17g %.17g %.17g %d %d %d %d\n", x(0), x(1), x(2), red, green, blue, c.vertex));
  }
  for (const auto& f : layer.faces) file.write(format("3 %zu %zu %zu\n", f[0], f[1], f[2]));
  for (const auto& e : layer.edges) file.write(format("%zu %zu\n", e[0], e[1]));
}

}  // namespace app
