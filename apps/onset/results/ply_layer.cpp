#include "onset/results/ply_layer.hpp"

#include "files/input_output.hpp"
#include "onset/results/coloured_ply.hpp"

namespace app {

int PlyLayer::add(const onset::Point& position, double toi, const onset::Point& normal) {
  vertices.push_back({position, normal, toi});
  return int(vertices.size()) - 1;
}

void write_ply(const std::string& path, const PlyLayer& layer, double earliest) {
  Output file(path);
  file.write(format("ply\nformat ascii 1.0\nelement vertex %zu\n", layer.vertices.size()));
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "toi"})
    file.write(format("property double %s\n", name));
  for (const char* name : {"red", "green", "blue"}) file.write(format("property uchar %s\n", name));
  if (!layer.faces.empty())
    file.write(format("element face %zu\nproperty list uchar int vertex_indices\n", layer.faces.size()));
  if (!layer.edges.empty())
    file.write(format("element edge %zu\nproperty int vertex1\nproperty int vertex2\n", layer.edges.size()));
  file.write("end_header\n");
  for (const PlyLayer::Vertex& v : layer.vertices) {
    for (const double x : v.position) file.write(format("%.17g ", x));
    for (const double x : v.normal) file.write(format("%.9g ", x));
    const auto [red, green, blue] = colour_of(v.toi, earliest);
    file.write(format("%.17g %d %d %d\n", v.toi, red, green, blue));
  }
  for (const std::vector<int>& face : layer.faces) {
    file.write(format("%zu", face.size()));
    for (const int v : face) file.write(format(" %d", v));
    file.write("\n");
  }
  for (const auto& e : layer.edges) file.write(format("%d %d\n", e[0], e[1]));
  file.close();
}

}  // namespace app
