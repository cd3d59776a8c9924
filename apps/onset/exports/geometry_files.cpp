#include "onset/exports/geometry_files.hpp"

#include <cmath>
#include <map>

#include "files/ply_output.hpp"

namespace app {
namespace {

onset::Point mix(const onset::Point& a, const onset::Point& b, double t) {
  onset::Point r;
  for (std::size_t i = 0; i < 3; ++i) r[i] = (1 - t) * a[i] + t * b[i];
  return r;
}

struct Exporter {
  const Scene& scene;
  const onset::ActiveSet& set;

  double earliest() const {
    const onset::Contact* first = set.earliest();
    return first == nullptr ? 1 : first->toi;
  }

  PlyLayer contacts() const {
    PlyLayer layer;
    for (const onset::Contact& contact : set) {
      onset::Point middle{};
      const bool plane = contact.kind == onset::PairKind::vertex_plane;
      for (std::size_t k = 0; k < (plane ? 1 : 4); ++k) {
        const int v = contact.vertices[k];
        const onset::Point x = mix(point(scene.x_t0, v), point(scene.x_t1, v), contact.toi);
        for (std::size_t a = 0; a < 3; ++a)
          middle[a] += (plane ? 1 : 0.5) * std::abs(contact.weights[k]) * x[a];
      }
      layer.add(middle, contact.toi, contact.normal);
    }
    return layer;
  }

  PlyLayer candidates(const onset::Candidates& pairs) const {
    std::map<std::array<int, 3>, double> toi;  // kind, a, b
    for (const onset::Contact& contact : set) toi[{int(contact.kind), contact.a, contact.b}] = contact.toi;
    PlyLayer layer;
    const auto add = [&](onset::PairKind kind, const std::array<int, 2>& p, const onset::Point& a,
                         const onset::Point& b) {
      const auto found = toi.find({int(kind), p[0], p[1]});
      const double t = found == toi.end() ? -1 : found->second;
      const int first = layer.add(a, t);
      layer.edges.push_back({first, layer.add(b, t)});
    };
    for (const auto& p : pairs.vertex_face)
      add(onset::PairKind::vertex_face, p, point(scene.x_t0, p[0]), face_middle(p[1]));
    for (const auto& p : pairs.edge_edge)
      add(onset::PairKind::edge_edge, p, edge_middle(p[0]), edge_middle(p[1]));
    for (const auto& p : pairs.vertex_edge)
      add(onset::PairKind::vertex_edge, p, point(scene.x_t0, p[0]), edge_middle(p[1]));
    return layer;
  }

  PlyLayer swept() const {
    PlyLayer layer;
    const std::vector<double> toi = toi_of_vertices(set, std::size_t(scene.x_t0.rows()));
    for (int v = 0; v < scene.x_t0.rows(); ++v) layer.add(point(scene.x_t0, v), toi[std::size_t(v)]);
    for (std::ptrdiff_t f = 0; f < scene.mesh.num_faces(); ++f) {
      const auto ids = scene.mesh.face(f);
      layer.faces.push_back({ids[0], ids[1], ids[2]});
    }
    for (const onset::Contact& contact : set) {
      const auto& v = contact.vertices;
      if (contact.kind != onset::PairKind::edge_edge) {
        const int from = layer.add(point(scene.x_t0, v[0]), contact.toi);
        layer.edges.push_back({from, layer.add(point(scene.x_t1, v[0]), contact.toi)});
        if (contact.kind == onset::PairKind::vertex_plane) continue;
        const std::size_t sides = contact.kind == onset::PairKind::vertex_edge ? 1 : 3;
        for (std::size_t c = 0; c < sides; ++c) sweep(layer, v[1 + c], v[1 + (c + 1) % 3], contact.toi);
      } else {
        sweep(layer, v[0], v[1], contact.toi);
        sweep(layer, v[2], v[3], contact.toi);
      }
    }
    return layer;
  }

 private:
  onset::Point face_middle(int f) const {
    const auto v = scene.mesh.face(f);
    return mix(mix(point(scene.x_t0, v[0]), point(scene.x_t0, v[1]), 0.5), point(scene.x_t0, v[2]), 1.0 / 3);
  }
  onset::Point edge_middle(int e) const {
    const auto v = scene.mesh.edge(e);
    return mix(point(scene.x_t0, v[0]), point(scene.x_t0, v[1]), 0.5);
  }
  void sweep(PlyLayer& layer, int v, int w, double toi) const {
    layer.faces.push_back({layer.add(point(scene.x_t0, v), toi), layer.add(point(scene.x_t0, w), toi),
                           layer.add(point(scene.x_t1, w), toi), layer.add(point(scene.x_t1, v), toi)});
  }
};

}  // namespace

std::vector<std::string> geometry_files(const std::string& path) {
  const std::string ending = ".ply";
  const bool has = path.size() > ending.size() && path.substr(path.size() - ending.size()) == ending;
  const std::string stem = has ? path.substr(0, path.size() - ending.size()) : path;
  return {stem + "-contacts.ply", stem + "-swept.ply", stem + "-candidates.ply"};
}

void write_geometry(const std::string& path, const Scene& scene, const onset::Options& options,
                    const onset::ActiveSet& set, Outputs& outputs) {
  const std::vector<std::string> files = geometry_files(path);
  const Exporter exporter{scene, set};
  const double earliest = exporter.earliest();
  write_ply(outputs.file(files[0]), exporter.contacts(), earliest);
  write_ply(outputs.file(files[1]), exporter.swept(), earliest);
  onset::Options all = options;
  all.memory_limit = onset::Options().memory_limit;
  write_ply(outputs.file(files[2]),
            exporter.candidates(onset::compute_candidates(scene.mesh, scene.start(), scene.end(), all)),
            earliest);
}

}  // namespace app
