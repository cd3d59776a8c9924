#include "files/queries/query_kind.hpp"

#include <cctype>
#include <filesystem>
#include <initializer_list>

#include "files/error.hpp"

namespace app {
namespace {

// Letters in lower case, every run of anything else a '-': "/326vf.csv" is "-vf-csv-".
std::string words(const std::string& name) {
  std::string text = "-";
  for (const unsigned char c : name) {
    if (std::isalpha(c))
      text += char(std::tolower(c));
    else if (text.back() != '-')
      text += '-';
  }
  return text + "-";
}

bool says(const std::string& words, std::initializer_list<const char*> names) {
  for (const char* name : names)
    if (words.find(name) != std::string::npos) return true;
  return false;
}

}  // namespace

const char* kind_name(onset::PairKind kind) {
  switch (kind) {
    case onset::PairKind::vertex_face:
      return "vf";
    case onset::PairKind::edge_edge:
      return "ee";
    case onset::PairKind::vertex_edge:
      return "ve";
    case onset::PairKind::vertex_plane:
      return "vp";
  }
  return "?";
}

onset::PairKind kind_from_path(const std::string& path) {
  for (std::filesystem::path p = path; p.has_filename(); p = p.parent_path()) {
    const std::string name = words(p.filename().string());
    const bool vf = says(name, {"-vertex-face-", "-vf-"}), ee = says(name, {"-edge-edge-", "-ee-"});
    if (vf && ee) break;
    if (vf) return onset::PairKind::vertex_face;
    if (ee) return onset::PairKind::edge_edge;
  }
  throw InputError(path + ": the path does not tell vertex-face (vf) from edge-edge (ee): give --kind");
}

onset::PairKind kind_of_file(const std::string& path, const std::string& name) {
  if (name.empty()) return kind_from_path(path);
  return name == kind_name(onset::PairKind::vertex_face) ? onset::PairKind::vertex_face
                                                         : onset::PairKind::edge_edge;
}

}  // namespace app
