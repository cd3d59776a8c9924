#include "ply_header.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <sstream>

namespace app {
namespace {

const std::set<std::string> kFloatTypes = {"float", "float32", "double", "float64"};
const std::set<std::string> kTypes = {"char",   "int8",    "uchar",  "uint8",  "short", "int16",
                                      "ushort", "uint16",  "int",    "int32",  "uint",  "uint32",
                                      "float",  "float32", "double", "float64"};
const std::set<std::string> kIndexTypes = {"int", "int32", "uint", "uint32"};

struct Header {
  std::string element;                        // the one that properties belong to
  std::map<std::string, std::string> vertex;  // property name -> type
  bool has_faces = false, has_indices = false;
};

std::string add_property(Header& header, std::istringstream& words) {
  std::string type, count_type, name;
  words >> type;
  const bool list = type == "list";
  if (list) words >> count_type >> type;
  if (!(words >> name)) return "a property without type or name";
  if (!kTypes.count(type)) return "property " + name + " has unknown type '" + type + "'";
  if (list && (!kTypes.count(count_type) || kFloatTypes.count(count_type)))
    return "property " + name + " has count type '" + count_type + "'";
  if (header.element == "vertex" && !list) header.vertex[name] = type;
  if (header.element == "face" && list && (name == "vertex_indices" || name == "vertex_index")) {
    if (!kIndexTypes.count(type)) return "property " + name + " of type '" + type + "': int or uint expected";
    header.has_indices = true;
  }
  return "";
}

std::string missing(const Header& header) {
  for (const char* name : {"x", "y", "z"}) {
    const auto found = header.vertex.find(name);
    if (found == header.vertex.end()) return std::string("no vertex property ") + name;
    if (!kFloatTypes.count(found->second))
      return std::string("vertex property ") + name + " of type '" + found->second +
             "': float or double expected";
  }
  if (!header.has_faces) return "no faces";
  return header.has_indices ? "" : "no face property vertex_indices";
}

}  // namespace

std::string ply_header_problem(std::istream& in) {
  Header header;
  std::string line, word;
  for (int row = 1; std::getline(in, line); ++row) {
    std::istringstream words(line);
    words >> word;
    if (row == 1 && word != "ply") return "not a PLY file";
    if (word == "end_header") return missing(header);
    if (word == "element") {
      words >> header.element;
      header.has_faces |= header.element == "face";
    }
    if (word == "property") {
      const std::string problem = add_property(header, words);
      if (!problem.empty()) return problem;
    }
  }
  return "the header has no end";
}

}  // namespace app
