#include "onset/results/start_report.hpp"

#include <algorithm>

#include "files/queries/query_kind.hpp"
#include "onset/results/report.hpp"

namespace app {
namespace {

constexpr std::size_t kShown = 10;

// What the command line has for it; the library's text ends with the calls of C++.
const char* flag_for(onset::StartFault fault) {
  switch (fault) {
    case onset::StartFault::intersecting:
      return "no option leaves them out: move them apart";
    case onset::StartFault::touching:
      return "--touching-may-pass-through, where they touch from the right side";
    case onset::StartFault::within_separation:
      return "--min-separation, a smaller one";
    case onset::StartFault::copied_vertices:
      return "--weld, where they are the copies of a seam";
    case onset::StartFault::faces_without_area:
      return "no option leaves them out: they are taken for the segments that they are";
    case onset::StartFault::unused_vertices:
      return "lines 'p' of an OBJ file declare points, else they meet faces only";
  }
  return "";
}

// Copies make whole neighbourhoods touch.
std::string cure(const onset::StartReport& report, onset::StartFault fault) {
  const bool by_copies = !report.copied_vertices.empty() &&
                         (fault == onset::StartFault::intersecting || fault == onset::StartFault::touching);
  return std::string(flag_for(fault)) +
         (by_copies ? "; copied vertices make many of these: --weld, where they are the copies of a seam"
                    : "");
}

std::string what_is_found(const std::string& text) { return text.substr(0, text.find(": ")); }

std::string in_words(const onset::Intersection& p) {
  const char* verb = p.kind == onset::IntersectionKind::crossing   ? "goes through"
                     : p.kind == onset::IntersectionKind::touching ? "touches"
                                                                   : "overlaps";
  const auto& v = p.vertices;
  if (v[3] == v[4])  // two edges in the plane
    return describe_edge(p.edge, v[0], v[1]) + " " + verb + " " + describe_edge(p.face, v[2], v[3]);
  return describe_edge(p.edge, v[0], v[1]) +
         format(" %s face %d (vertices %d %d %d)", verb, p.face, v[2], v[3], v[4]);
}

template <class List, class Line>
std::string first_ten(const List& list, Line&& line) {
  std::string text;
  for (std::size_t i = 0; i < std::min(list.size(), kShown); ++i) text += "  " + line(list[i]) + "\n";
  return text + (list.size() > kShown ? format("  ... %zu more\n", list.size() - kShown) : "");
}

std::string describe_copies(const StartFindings& f) {
  const auto line = [&](const std::array<int, 2>& copy) {
    std::string text = format("vertices %d and %d are at one place", copy[0], copy[1]);
    if (!f.copies) return text;
    const auto& parting = f.copies->parting;
    const bool parts = std::binary_search(parting.begin(), parting.end(), copy);
    return text + (parts ? ", not at the end of the step" : " at both ends of the step");
  };
  std::string text = first_ten(f.report.copied_vertices, line);
  if (f.copies)
    text += format("  %zu stay together to the end of the step, which --weld makes one, %zu part\n",
                   f.copies->together.size(), f.copies->parting.size());
  return text;
}

std::string describe_list(const StartFindings& f, onset::StartFault fault) {
  const onset::StartReport& r = f.report;
  switch (fault) {
    case onset::StartFault::intersecting:
      return first_ten(r.intersections, in_words);
    case onset::StartFault::touching:
      return first_ten(r.touching, [](const onset::Pair& p) { return app::describe(p); });
    case onset::StartFault::within_separation:
      return first_ten(r.within_separation, [](const onset::ClosePair& p) {
        return app::describe(p) + format(": %.6g apart, %.6g to be kept", p.distance, p.separation);
      });
    case onset::StartFault::copied_vertices:
      return describe_copies(f);
    case onset::StartFault::faces_without_area:
      return first_ten(r.faces_without_area, [&](int face) {
        const std::array<int, 3> v = f.scene.mesh.face(face);
        return format("face %d (vertices %d %d %d)", face, v[0], v[1], v[2]);
      });
    default:
      return first_ten(r.unused_vertices, [](int v) { return format("vertex %d", v); });
  }
}

Json to_json(const onset::Intersection& p) {
  return {{"edge", p.edge}, {"face", p.face}, {"kind", onset::to_string(p.kind)}, {"vertices", p.vertices}};
}

Json to_json(const onset::ClosePair& p) {
  Json json = app::to_json(static_cast<const onset::Pair&>(p));
  json["distance"] = p.distance, json["separation"] = p.separation;
  return json;
}

template <class List>
Json list_json(const List& list) {
  Json json = Json::array();
  for (const auto& entry : list) json.push_back(to_json(entry));
  return json;
}

// The given ids, then empty fields up to five.
std::string vertex_fields(const int* first, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < 5; ++i) text += i < count ? format(",%d", first[i]) : ",";
  return text;
}

std::string pair_row(const char* fault, const onset::Pair& p) {
  const std::size_t vertices = p.kind == onset::PairKind::vertex_plane ? 1 : 4;
  return format("%s,%s,%d,%d", fault, kind_name(p.kind), p.a, p.b) +
         vertex_fields(p.vertices.data(), vertices);
}

}  // namespace

CopiedVertices at_the_end(const std::vector<std::array<int, 2>>& copies, const Points& x_t1) {
  CopiedVertices result;
  for (const auto& copy : copies)
    (x_t1.row(copy[0]) == x_t1.row(copy[1]) ? result.together : result.parting).push_back(copy);
  return result;
}

std::string describe(const StartFindings& f) {
  const onset::StartReport& r = f.report;
  std::string text = "start       ";
  if (r.outcome != onset::Outcome::free)
    text += format("not known: %s\n", outcome_name(r.outcome));
  else if (r.clean())
    text += "clean\n";
  else
    text +=
        r.acceptable() ? "a step may start here, with what follows in mind\n" : "a step cannot start here\n";
  if (r.vertex >= 0) text += format("vertex      %d\n", r.vertex);
  for (const onset::StartFinding& finding : r.findings) {
    text += "\n" + what_is_found(finding.text) + "\n" + describe_list(f, finding.fault);
    text += "  on the command line: " + cure(r, finding.fault) + "\n";
  }
  return text + format("\nseconds     %.3g\n", r.seconds);
}

Json to_json(const StartFindings& f) {
  const onset::StartReport& r = f.report;
  Json json = {{"clean", r.clean()}, {"acceptable", r.acceptable()}, {"outcome", outcome_name(r.outcome)}};
  if (r.vertex >= 0) json["vertex"] = r.vertex;
  json["findings"] = Json::array();
  for (const onset::StartFinding& finding : r.findings)
    json["findings"].push_back({{"fault", onset::to_string(finding.fault)},
                                {"count", finding.count},
                                {"text", finding.text},
                                {"command_line", cure(r, finding.fault)}});
  json["intersecting"] = list_json(r.intersections);
  json["touching"] = Json::array();
  for (const onset::Pair& p : r.touching) json["touching"].push_back(app::to_json(p));
  json["within_separation"] = list_json(r.within_separation);
  json["copied_vertices"] = r.copied_vertices;
  if (f.copies)
    json["copies_that_stay_together"] = f.copies->together, json["copies_that_part"] = f.copies->parting;
  json["faces_without_area"] = r.faces_without_area;
  json["unused_vertices"] = r.unused_vertices;
  json["seconds"] = r.seconds;
  return json;
}

void write_csv(Output& csv, const StartFindings& f) {
  const onset::StartReport& r = f.report;
  csv.write(std::string(kStartColumns) + "\n");
  for (const onset::Intersection& p : r.intersections)
    csv.write(format("intersecting,%s,%d,%d", onset::to_string(p.kind), p.edge, p.face) +
              vertex_fields(p.vertices.data(), 5) + ",,\n");
  for (const onset::Pair& p : r.touching) csv.write(pair_row("touching", p) + ",,\n");
  for (const onset::ClosePair& p : r.within_separation)
    csv.write(pair_row("within_separation", p) + format(",%.17g,%.17g\n", p.distance, p.separation));
  for (const auto& copy : r.copied_vertices)
    csv.write("copied_vertices,,," + vertex_fields(copy.data(), 2) + ",,\n");
  for (const int face : r.faces_without_area)
    csv.write(format("faces_without_area,,%d,", face) + vertex_fields(f.scene.mesh.face(face).data(), 3) +
              ",,\n");
  for (const int v : r.unused_vertices) csv.write("unused_vertices,,," + vertex_fields(&v, 1) + ",,\n");
}

}  // namespace app
