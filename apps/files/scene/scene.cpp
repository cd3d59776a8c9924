#include "files/scene/scene.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "files/error.hpp"
#include "files/scene/places.hpp"
#include "files/scene/triangulate.hpp"
#include "files/text_lines.hpp"

namespace app {
namespace {

using Edge = std::array<std::int64_t, 2>;

std::string list(const std::int64_t* ids, std::size_t count) {
  constexpr std::size_t kShown = 10;
  std::string text;
  for (std::size_t i = 0; i < std::min(count, kShown); ++i) text += (i ? " " : "") + std::to_string(ids[i]);
  return "(" + text + (count > kShown ? " ...)" : ")");
}

std::string counts(const char* what, std::size_t a, std::size_t b) {
  return std::to_string(a) + " against " + std::to_string(b) + " " + what;
}

std::string differing(const char* what, std::size_t row, const std::string& a, const std::string& b) {
  return std::string(what) + " " + std::to_string(row) + " is " + a + " against " + b;
}

std::string corners(const Polygons& p, std::size_t i) {
  return list(p.corners.data() + p.begin(i), p.corners_of(i));
}

// The first difference in words; empty when there is none.
std::string difference(const MeshFile& a, const MeshFile& b) {
  if (a.positions.rows() != b.positions.rows())
    return counts("vertices", std::size_t(a.positions.rows()), std::size_t(b.positions.rows()));
  if (a.polygons.size() != b.polygons.size()) return counts("faces", a.polygons.size(), b.polygons.size());
  for (std::size_t f = 0; f < a.polygons.size(); ++f) {
    const auto begin = [f](const Polygons& p) { return p.corners.begin() + std::ptrdiff_t(p.begin(f)); };
    const std::size_t n = a.polygons.corners_of(f);
    const auto first = begin(a.polygons);
    if (n != b.polygons.corners_of(f) || !std::equal(first, first + std::ptrdiff_t(n), begin(b.polygons)))
      return differing("face", f, corners(a.polygons, f), corners(b.polygons, f));
  }
  if (a.wires.size() != b.wires.size()) return counts("wires", a.wires.size(), b.wires.size());
  for (std::size_t w = 0; w < a.wires.size(); ++w)
    if (a.wires[w] != b.wires[w])
      return differing("wire", w, list(a.wires[w].data(), 2), list(b.wires[w].data(), 2));
  if (a.points.size() != b.points.size()) return counts("points", a.points.size(), b.points.size());
  for (std::size_t p = 0; p < a.points.size(); ++p)
    if (a.points[p] != b.points[p])
      return differing("point", p, list(&a.points[p], 1), list(&b.points[p], 1));
  return "";
}

// Those of the faces, then the wires, each once.
Eigen::MatrixXi all_edges(const Faces& faces, const std::vector<Edge>& wires) {
  const Eigen::MatrixXi of_faces = onset::edges(faces);
  std::set<Edge> known;
  const auto ordered = [](std::int64_t v, std::int64_t w) { return Edge{std::min(v, w), std::max(v, w)}; };
  if (!wires.empty())
    for (Eigen::Index e = 0; e < of_faces.rows(); ++e) known.insert(ordered(of_faces(e, 0), of_faces(e, 1)));
  std::vector<Edge> more;
  for (const Edge& wire : wires)
    if (known.insert(ordered(wire[0], wire[1])).second) more.push_back(wire);
  Eigen::MatrixXi edges(of_faces.rows() + Eigen::Index(more.size()), 2);
  edges.topRows(of_faces.rows()) = of_faces;
  for (std::size_t i = 0; i < more.size(); ++i)
    edges.row(of_faces.rows() + Eigen::Index(i)) << int(more[i][0]), int(more[i][1]);
  return edges;
}

// Those that are no vertex of an edge or a face, which take part as it is, each once.
std::vector<int> lone_points(const onset::Mesh& mesh, const std::vector<std::int64_t>& declared) {
  std::vector<bool> taken(std::size_t(mesh.num_vertices()));
  for (std::ptrdiff_t e = 0; e < mesh.num_edges(); ++e)
    for (const int v : mesh.edge(e)) taken[std::size_t(v)] = true;
  std::vector<int> points;
  for (const std::int64_t v : declared) {
    if (!taken[std::size_t(v)]) points.push_back(int(v));
    taken[std::size_t(v)] = true;
  }
  return points;
}

onset::Mesh make_mesh(const MeshFile& file) {
  try {
    const Faces faces = triangulate(file);
    onset::Mesh mesh(file.positions.rows(), all_edges(faces, file.wires), faces);
    onset::CollisionRules rules;
    if (!file.points.empty()) rules.points = lone_points(mesh, file.points);
    mesh.set_rules(rules);
    return mesh;
  } catch (const std::invalid_argument& e) {  // more than its ids can number, say
    throw InputError(file.path + ": " + e.what());
  }
}

void note_triangles(MeshFile& file) {
  const Polygons& p = file.polygons;
  std::size_t larger = 0;
  for (std::size_t i = 0; i < p.size(); ++i) larger += p.corners_of(i) > 3;
  if (larger > 0)
    file.notes.push_back("triangulated " + counted(larger, "polygon") + " of more than 3 corners: of " +
                         counted(p.size(), "face") + " there are " +
                         counted(p.corners.size() - 2 * p.size(), "triangle") + ", numbered in that order");
}

// What is said about both files is said once.
std::vector<std::string> notes(const MeshFile& a, const MeshFile& b) {
  std::vector<std::string> all;
  for (const std::string& note : a.notes) all.push_back(a.path + ": " + note);
  for (const std::string& note : b.notes)
    if (std::find(a.notes.begin(), a.notes.end(), note) == a.notes.end()) all.push_back(b.path + ": " + note);
  return all;
}

}  // namespace

Scene read_scene(const std::string& path_t0, const std::string& path_t1) {
  MeshFile t0 = read_mesh(path_t0), t1 = read_mesh(path_t1);
  merge_corners(t0, t1);
  const std::string differs = difference(t0, t1);
  if (!differs.empty()) throw InputError(path_t0 + " and " + path_t1 + ": different topology: " + differs);
  note_triangles(t0);
  return {make_mesh(t0), std::move(t0.positions), std::move(t1.positions), notes(t0, t1), path_t0, false};
}

}  // namespace app
