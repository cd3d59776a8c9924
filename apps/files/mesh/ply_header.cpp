#include "files/mesh/ply_header.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "files/text_lines.hpp"

namespace app {
namespace {

std::optional<PlyType> to_type(std::string_view name) {
  static const std::map<std::string_view, PlyType> types = {
      {"char", PlyType::int8},      {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
      {"uint8", PlyType::uint8},    {"short", PlyType::int16},     {"int16", PlyType::int16},
      {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},   {"int", PlyType::int32},
      {"int32", PlyType::int32},    {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
      {"float", PlyType::float32},  {"float32", PlyType::float32}, {"double", PlyType::float64},
      {"float64", PlyType::float64}};
  const auto found = types.find(name);
  return found == types.end() ? std::nullopt : std::optional<PlyType>(found->second);
}

class HeaderReader {
 public:
  HeaderReader(std::string_view bytes, const MeshBuilder& mesh) : rest_(bytes), mesh_(mesh) {}

  PlyHeader read() {
    if (!next() || words_.size() != 1 || words_[0] != "ply") fail("not a PLY file");
    while (next()) {
      if (words_.empty() || words_[0] == "comment" || words_[0] == "obj_info") continue;
      if (words_[0] == "end_header") return finish();
      statement();
    }
    fail("the header has no end");
  }

 private:
  // The header's lines end as its first one does: what follows a lone CR may be data that starts with LF.
  bool next() {
    if (rest_.empty()) return false;
    if (header_.lines++ == 0) {
      const std::size_t end = rest_.find_first_of("\r\n");
      if (end != rest_.npos) line_end_ = rest_.substr(end, rest_.substr(end, 2) == "\r\n" ? 2 : 1);
    }
    const std::size_t end = std::min(rest_.find(line_end_), rest_.size());
    split_words(rest_.substr(0, end), words_);
    rest_.remove_prefix(std::min(rest_.size(), end + line_end_.size()));
    return true;
  }

  void statement() {
    if (words_[0] == "format") return format();
    if (words_[0] == "element") return element();
    if (words_[0] == "property") return property();
    fail("unknown line in the header: " + quoted(words_));
  }

  void format() {
    if (words_.size() != 3 || words_[2] != "1.0") fail("unknown " + quoted(words_));
    if (words_[1] == "ascii")
      header_.encoding = PlyHeader::Encoding::ascii;
    else if (words_[1] == "binary_little_endian")
      header_.encoding = PlyHeader::Encoding::little_endian;
    else if (words_[1] == "binary_big_endian")
      header_.encoding = PlyHeader::Encoding::big_endian;
    else
      fail("unknown " + quoted(words_));
    has_format_ = true;
  }

  void element() {
    if (words_.size() != 3) fail("an element has a name and a count, here is " + quoted(words_));
    const std::optional<std::int64_t> count = parse_whole(words_[2]);
    const std::string name(words_[1]);
    if (!count || *count < 0) fail("element " + name + " has count " + quoted(words_[2]));
    if (!elements_.insert(name).second) fail("a second element " + name);
    header_.elements.push_back({name, *count, header_.lines, {}});
    properties_.clear();
  }

  void property() {
    if (header_.elements.empty()) fail("a property before any element");
    PlyElement& element = header_.elements.back();
    PlyProperty p;
    p.list = words_.size() > 1 && words_[1] == "list";
    p.line = header_.lines;
    if (words_.size() != (p.list ? 5u : 3u))
      fail("a property has a type and a name, here is " + quoted(words_));
    p.name = std::string(words_.back());
    p.type = type(p.name, words_[words_.size() - 2]);
    if (p.list) p.count_type = type(p.name, words_[2]);
    if (!is_whole(p.count_type)) fail("property " + p.name + " has count type " + quoted(words_[2]));
    if (!properties_.insert(p.name).second)
      fail("a second property " + p.name + " of element " + element.name);
    element.properties.push_back(p);
  }

  PlyType type(const std::string& property, std::string_view name) {
    const std::optional<PlyType> found = to_type(name);
    if (!found) fail("property " + property + " has unknown type " + quoted(name));
    return *found;
  }

  PlyHeader finish() {
    if (!has_format_) fail("no format in the header");
    for (const PlyElement& e : header_.elements)
      if (e.count > 0 && e.properties.empty()) mesh_.fail(e.line, "element " + e.name + " has no properties");
    header_.data = rest_;
    return std::move(header_);
  }

  [[noreturn]] void fail(const std::string& cause) const { mesh_.fail(header_.lines, cause); }

  std::string_view rest_, line_end_ = "\n";
  const MeshBuilder& mesh_;
  std::vector<std::string_view> words_;
  PlyHeader header_;
  std::set<std::string> elements_, properties_;  // names so far, properties of the last element
  bool has_format_ = false;
};

}  // namespace

std::size_t bytes_of(PlyType type) {
  constexpr std::size_t bytes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return bytes[static_cast<std::size_t>(type)];
}

std::size_t PlyElement::least_bytes(bool ascii) const {
  std::size_t bytes = 0;
  for (const PlyProperty& p : properties) bytes += ascii ? 2 : bytes_of(p.list ? p.count_type : p.type);
  return bytes;
}

PlyHeader read_ply_header(std::string_view bytes, const MeshBuilder& mesh) {
  return HeaderReader(without_mark(bytes), mesh).read();
}

}  // namespace app
