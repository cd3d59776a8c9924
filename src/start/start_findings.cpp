#include "src/start/start_findings.hpp"

#include "base/text_stream.hpp"

namespace onset {
namespace {

template <class Ids>
std::string listed(const Ids& ids) {
  TextStream s;
  for (std::size_t i = 0; i < ids.size(); ++i)
    s << (i == 0 ? "" : i + 1 == ids.size() ? " and " : ", ") << ids[i];
  return s.str();
}

std::string counted(std::size_t count, const char* one, const char* more) {
  return std::to_string(count) + " " + (count == 1 ? one : more);
}

std::string vertices_of(const int* first, const int* last) {
  return (last - first == 1 ? "vertex " : "vertices ") + listed(std::vector<int>(first, last));
}

std::string named(const Pair& p) {
  const int* v = p.vertices.data();
  if (p.kind == PairKind::vertex_plane)
    return "vertex " + std::to_string(p.a) + " and plane " + std::to_string(p.b);
  if (p.kind == PairKind::vertex_face)
    return "vertex " + std::to_string(p.a) + " and face " + std::to_string(p.b) + " (" +
           vertices_of(v + 1, v + 4) + ")";
  const auto edge = [&](int id, const int* ends) {
    return "edge " + std::to_string(id) + " (" + vertices_of(ends, ends + (ends[0] == ends[1] ? 1 : 2)) + ")";
  };
  if (p.kind == PairKind::vertex_edge) return "vertex " + std::to_string(p.a) + " and " + edge(p.b, v + 1);
  return edge(p.a, v) + " and " + edge(p.b, v + 2);
}

// Copied vertices at a seam make whole neighbourhoods touch.
std::string seam_hint(const StartReport& report) {
  return report.copied_vertices.empty() ? "" : "; copied vertices make many of these: mend them first";
}

std::string of_intersections(const Mesh& mesh, const StartReport& report) {
  std::size_t crossing = 0;
  for (const Intersection& p : report.intersections) crossing += p.kind == IntersectionKind::crossing;
  const Intersection& p = report.intersections.front();
  const int* v = p.vertices.data();
  TextStream s;
  const bool in_plane = mesh.dimension() == 2;
  const auto edge_at = [&](const int* ends) {
    return vertices_of(ends, ends + (ends[0] == ends[1] ? 1 : 2));
  };
  s << (in_plane
            ? counted(report.intersections.size(), "pair of edges intersects", "pairs of edges intersect")
            : counted(report.intersections.size(), "edge-face pair intersects", "edge-face pairs intersect"))
    << " (" << crossing << " crossing), first edge " << p.edge << " (" << edge_at(v) << ") and "
    << (in_plane ? "edge " : "face ") << p.face << " ("
    << (in_plane ? edge_at(v + 2) : vertices_of(v + 2, v + 5)) << "), " << to_string(p.kind)
    << ": move them apart; to leave out those that are meant, "
       "rules.excluded_intersections = report.intersections"
    << seam_hint(report);
  return s.str();
}

std::string of_touching(const StartReport& report) {
  return counted(report.touching.size(), "pair touches", "pairs touch") + ", first " +
         named(report.touching.front()) +
         ": move them apart; to leave them out, rules.excluded_pairs = report.touching; to let them part "
         "where they touch "
         "from the right side, Options::touching_may_pass_through" +
         seam_hint(report);
}

std::string of_close(const StartReport& report) {
  const ClosePair& p = report.within_separation.front();
  TextStream s;
  s << counted(report.within_separation.size(), "pair is", "pairs are") << " within the separation, first "
    << named(p) << ", " << p.distance << " apart where " << p.separation
    << " is to be kept: move them apart, lower Options::min_separation or rules.thickness, give "
       "rules.rest_positions where "
       "the mesh is finer than that, or leave them out: "
       "rules.excluded_pairs = {report.within_separation.begin(), report.within_separation.end()}";
  return s.str();
}

std::string of_copies(const StartReport& report) {
  return counted(report.copied_vertices.size(), "vertex is", "vertices are") +
         " at the place of another, first vertices " + listed(report.copied_vertices.front()) +
         ": where they are the copies of a seam, rules.weld = true, or "
         "rules.excluded_vertices = onset::duplicate_vertices(x); else move them apart";
}

std::string of_faces(const Mesh& mesh, const StartReport& report) {
  const int f = report.faces_without_area.front();
  const std::array<int, 3> v = mesh.face(f);
  return counted(report.faces_without_area.size(), "face has", "faces have") + " no area, first face " +
         std::to_string(f) + " (" + vertices_of(v.data(), v.data() + 3) +
         "): they are taken for the segments that they are; leave these rows out of the faces of Mesh(x, "
         "edges, faces) to "
         "keep their edges alone";
}

std::string of_unused(const Mesh& mesh, const StartReport& report) {
  const bool in_plane = mesh.dimension() == 2;
  return counted(report.unused_vertices.size(), "vertex belongs", "vertices belong") +
         " to no edge and no face, first vertex " + std::to_string(report.unused_vertices.front()) +
         ": they meet " + (in_plane ? "edges" : "faces") +
         " only; rules.points = report.unused_vertices lets them meet " + (in_plane ? "" : "edges and ") +
         "each other";
}

}  // namespace

std::vector<StartFinding> start_findings(const Mesh& mesh, const StartReport& r) {
  std::vector<StartFinding> findings;
  const auto add = [&](StartFault fault, std::size_t count, auto&& text) {
    if (count > 0) findings.push_back({fault, count, text()});
  };
  add(StartFault::intersecting, r.intersections.size(), [&] { return of_intersections(mesh, r); });
  add(StartFault::touching, r.touching.size(), [&] { return of_touching(r); });
  add(StartFault::within_separation, r.within_separation.size(), [&] { return of_close(r); });
  add(StartFault::copied_vertices, r.copied_vertices.size(), [&] { return of_copies(r); });
  add(StartFault::faces_without_area, r.faces_without_area.size(), [&] { return of_faces(mesh, r); });
  add(StartFault::unused_vertices, r.unused_vertices.size(), [&] { return of_unused(mesh, r); });
  return findings;
}

const char* to_string(StartFault fault) noexcept {
  switch (fault) {
    case StartFault::intersecting:
      return "intersecting";
    case StartFault::touching:
      return "touching";
    case StartFault::within_separation:
      return "within_separation";
    case StartFault::copied_vertices:
      return "copied_vertices";
    case StartFault::faces_without_area:
      return "faces_without_area";
    case StartFault::unused_vertices:
      return "unused_vertices";
  }
  return "unknown";
}

}  // namespace onset
