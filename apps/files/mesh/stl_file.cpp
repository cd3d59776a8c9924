#include <cstring>

#include "files/mesh/mesh_builder.hpp"
#include "files/mesh/mesh_file.hpp"
#include "files/text_lines.hpp"

namespace app {
namespace {

constexpr std::size_t kHeader = 80, kCount = 4, kRow = 50;

// Little-endian bytes.
template <class T>
T value_at(std::string_view bytes, std::size_t at) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < 4; ++i)
    bits |= std::uint32_t(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
  T value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

MeshFile read_binary(MeshBuilder mesh, std::string_view bytes) {
  mesh.corners_are_vertices();
  std::int64_t id = 0;
  for (std::size_t at = kHeader + kCount; at < bytes.size(); at += kRow) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::size_t first = at + 12 * (corner + 1);  // behind the normal
      mesh.vertex({value_at<float>(bytes, first), value_at<float>(bytes, first + 4),
                   value_at<float>(bytes, first + 8)},
                  0);
    }
    mesh.face({id, id + 1, id + 2}, {"face", id / 3, 0});
    id += 3;
  }
  return mesh.finish();
}

// "facet normal", three "vertex" in a loop, "endfacet"; what a solid is called, or how often there is one, is
// all the same.
class TextReader {
 public:
  TextReader(MeshBuilder mesh, std::string_view text) : mesh_(std::move(mesh)), lines_(text) {}

  MeshFile read() {
    mesh_.corners_are_vertices();
    for (std::string_view line; lines_.next(line);) {
      split_words(line, words_);
      if (!words_.empty()) statement();
    }
    if (in_facet_) mesh_.fail(lines_.number(), "the file ends within a facet");
    return mesh_.finish();
  }

 private:
  void statement() {
    std::string keyword(words_[0]);
    for (char& c : keyword)
      if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
    if (keyword == "facet") return begin();
    if (keyword == "vertex") return vertex();
    if (keyword == "endfacet") return end();
    if (keyword != "solid" && keyword != "endsolid" && keyword != "outer" && keyword != "endloop")
      mesh_.fail(lines_.number(), "unknown line " + quoted(words_));
  }

  void begin() {
    if (in_facet_) mesh_.fail(lines_.number(), "a facet within a facet");
    in_facet_ = true;
    first_ = mesh_.vertices();
  }

  void vertex() {
    const Place place{"vertex", mesh_.vertices(), lines_.number()};
    if (!in_facet_) mesh_.fail(place, "is in no facet");
    std::array<double, 3> position{};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::optional<double> value = words_.size() == 4 ? parse_double(words_[i + 1]) : std::nullopt;
      if (!value) mesh_.fail(place, "is not three finite numbers: " + quoted(words_));
      position[i] = *value;
    }
    mesh_.vertex(position, lines_.number(), quoted(words_));
  }

  void end() {
    const Place place{"face", faces_++, lines_.number()};
    const std::int64_t corners = mesh_.vertices() - first_;
    if (!in_facet_ || corners != 3)
      mesh_.fail(place, "has " + std::to_string(corners) + " corners, 3 expected");
    mesh_.face({first_, first_ + 1, first_ + 2}, place);
    in_facet_ = false;
  }

  MeshBuilder mesh_;
  Lines lines_;
  std::vector<std::string_view> words_;
  bool in_facet_ = false;
  std::int64_t first_ = 0, faces_ = 0;
};

}  // namespace

// A binary file may start with "solid", too: its size tells.
bool is_text_stl(const std::string& path, std::string_view head, std::uint64_t size) {
  const bool can_be_binary = head.size() >= kHeader + kCount;
  const std::uint64_t count = can_be_binary ? value_at<std::uint32_t>(head, kHeader) : 0;
  if (can_be_binary && size == kHeader + kCount + kRow * count) return false;
  std::vector<std::string_view> words;
  Lines lines(without_mark(head));
  std::string_view line;
  while (words.empty() && lines.next(line)) split_words(line, words);
  if (!words.empty() && (words[0] == "solid" || words[0] == "SOLID")) return true;
  const MeshBuilder mesh(path, 0);
  if (!can_be_binary) mesh.fail(0, "not an STL file");
  mesh.fail(0, "not an STL file, or cut off: as a binary one it has " + std::to_string(count) +
                   " faces, of " + std::to_string(kRow) + " bytes each, in " +
                   std::to_string(size - kHeader - kCount) + " bytes");
}

MeshFile read_stl(const std::string& path, std::string_view bytes) {
  MeshBuilder mesh(path, 0);
  if (is_text_stl(path, bytes, bytes.size())) return TextReader(std::move(mesh), without_mark(bytes)).read();
  return read_binary(std::move(mesh), bytes);
}

}  // namespace app
