#include "files/ply_output.hpp"

#include <algorithm>

namespace app {

Colour colour_of(double toi, double earliest) {
  if (toi < 0) return {200, 200, 200};
  const double t = earliest < 1 ? std::clamp((toi - earliest) / (1 - earliest), 0.0, 1.0) : 0;
  const auto byte = [](double x) { return std::uint8_t(255 * std::clamp(x, 0.0, 1.0)); };
  return {byte(2 - 2 * t), byte(t < 0.5 ? 2 * t : 2 - 2 * t), byte(2 * t - 1)};
}

std::vector<double> toi_of_vertices(const onset::ActiveSet& set, std::size_t vertices) {
  std::vector<double> toi(vertices, -1);
  for (const onset::Contact& contact : set)
    for (const int v : contact.vertices) {
      if (v < 0) continue;  // of a plane
      double& own = toi[std::size_t(v)];
      own = own < 0 ? contact.toi : std::min(own, contact.toi);
    }
  return toi;
}

void write_ply_header(Output& file, const std::vector<PlyRows>& elements) {
  file.write("ply\nformat ascii 1.0\n");
  for (const PlyRows& rows : elements) {
    file.write(format("element %s %zu\n", rows.element, rows.count));
    for (const char* property : rows.properties) file.write(format("property %s\n", property));
  }
  file.write("end_header\n");
}

void write_coloured_ply(Output& file, const Points& positions, const Faces& faces,
                        const std::vector<Colour>& colours) {
  write_ply_header(file, {{"vertex",
                           std::size_t(positions.rows()),
                           {"double x", "double y", "double z", "uchar red", "uchar green", "uchar blue"}},
                          ply_faces(std::size_t(faces.rows()))});
  for (Eigen::Index v = 0; v < positions.rows(); ++v) {
    const auto& [red, green, blue] = colours[std::size_t(v)];
    file.write(format("%.17g %.17g %.17g %d %d %d\n", positions(v, 0), positions(v, 1), positions(v, 2), red,
                      green, blue));
  }
  for (Eigen::Index f = 0; f < faces.rows(); ++f)
    file.write(format("3 %lld %lld %lld\n", faces(f, 0), faces(f, 1), faces(f, 2)));
}

int PlyLayer::add(const onset::Point& position, double toi, const onset::Point& normal) {
  vertices.push_back({position, normal, toi});
  return int(vertices.size()) - 1;
}

void write_ply(Output& file, const PlyLayer& layer, double earliest) {
  std::vector<PlyRows> header{{"vertex",
                               layer.vertices.size(),
                               {"double x", "double y", "double z", "double nx", "double ny", "double nz",
                                "double toi", "uchar red", "uchar green", "uchar blue"}}};
  if (!layer.faces.empty()) header.push_back(ply_faces(layer.faces.size()));
  if (!layer.edges.empty()) header.push_back(ply_edges(layer.edges.size()));
  write_ply_header(file, header);
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
}

}  // namespace app
