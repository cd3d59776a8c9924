#include <algorithm>
#include <cstring>

#include "files/mesh/mesh_builder.hpp"
#include "files/mesh/mesh_file.hpp"
#include "files/text_lines.hpp"

namespace app {
namespace {

using Words = std::vector<std::string_view>;

// "OFF" behind letters that say what else a vertex has.
struct OffHeader {
  std::size_t values = 3;  // of a vertex
  bool binary = false;
};

class OffReader {
 public:
  explicit OffReader(const std::string& path) : mesh_(path, 0) {}

 protected:
  // "COFF", say, maybe with the first count behind it; returns what is behind it.
  std::string_view keyword(std::string_view word, std::size_t line) {
    std::size_t end = word.find("OFF");
    if (end == word.npos) mesh_.fail(line, "not an OFF file");
    std::string_view letters = word.substr(0, end);
    const auto take = [&](std::string_view prefix) {
      const bool has = letters.substr(0, prefix.size()) == prefix;
      if (has) letters.remove_prefix(prefix.size());
      return has;
    };
    if (take("ST")) header_.values += 2;
    if (take("C")) header_.values += 4;
    if (take("N")) header_.values += 3;
    if (!letters.empty())
      mesh_.fail(line, quoted(word) +
                           " is not read: vertices of three coordinates, with ST, C, N before OFF at most");
    return word.substr(end + 3);
  }

  void check_counts(std::int64_t vertices, std::int64_t faces, std::size_t line, std::size_t bytes_left,
                    std::size_t vertex_bytes, std::size_t face_bytes) {
    const auto impossible = [&](std::int64_t count, std::size_t each) {
      return count < 0 || std::size_t(count) > (bytes_left + 1) / each;
    };
    const auto fail = [&](const char* what, std::int64_t count) {
      mesh_.fail(line, "it says that it has " + std::to_string(count) + " " + what + ", the file has " +
                           std::to_string(bytes_left) + " bytes left");
    };
    if (impossible(vertices, vertex_bytes)) fail("vertices", vertices);
    if (impossible(faces, face_bytes)) fail("faces", faces);
  }

  MeshBuilder mesh_;
  OffHeader header_;
};

class TextReader : OffReader {
 public:
  TextReader(const std::string& path, std::string_view text) : OffReader(path), lines_(text) {}

  MeshFile read() {
    if (!next()) mesh_.fail(0, "not an OFF file");
    const std::string_view behind = keyword(words_[0], lines_.number());
    if (behind.empty())
      words_.erase(words_.begin());
    else
      words_[0] = behind;  // "OFF8 12 0"
    if (words_.empty() && !next()) mesh_.fail(0, "no counts: the file ends before them");
    if (words_.size() < 2 || words_.size() > 3)
      mesh_.fail(lines_.number(), "numbers of vertices, faces and edges expected, not " + quoted(words_));
    const std::int64_t vertices = count(words_[0]), faces = count(words_[1]);
    check_counts(vertices, faces, lines_.number(), lines_.left(), 6, 2);
    for (std::int64_t i = 0; i < vertices; ++i) vertex({"vertex", i, 0});
    for (std::int64_t i = 0; i < faces; ++i) face({"face", i, 0});
    if (next())
      mesh_.fail(lines_.number(), "more than the numbers of vertices and faces say: " + quoted(words_));
    return mesh_.finish();
  }

 private:
  bool next() {
    std::string_view line;
    while (lines_.next(line)) {
      split_words(line, words_);
      if (!words_.empty()) return true;
    }
    return false;
  }

  Place next_row(Place place) {
    if (!next()) mesh_.fail(place, "is not there: the file ends before it");
    place.line = lines_.number();
    return place;
  }

  std::int64_t count(std::string_view word) {
    const std::optional<std::int64_t> value = parse_whole(word);
    if (!value || *value < 0)
      mesh_.fail(lines_.number(), "a number of elements expected, not " + quoted(word));
    return *value;
  }

  void vertex(Place place) {
    place = next_row(place);
    if (words_.size() == 2)
      mesh_.fail(place,
                 "has two coordinates: for two dimensions add a third coordinate of 0, and give --dim 2");
    std::array<double, 3> position{};
    for (std::size_t i = 0; i < words_.size(); ++i) {
      const std::optional<double> value = parse_double(words_[i]);
      if (!value || words_.size() < 3) mesh_.fail(place, "is not three finite numbers: " + quoted(words_));
      if (i < 3) position[i] = *value;
    }
    // Colours behind the coordinates are written under a plain OFF, too.
    if (words_.size() > header_.values + 4)
      mesh_.fail(place, "has " + std::to_string(words_.size()) + " numbers: " + quoted(words_));
    mesh_.vertex(position, place.line, quoted(words_));
  }

  // A count, as many indices, and a colour of up to four numbers.
  void face(Place place) {
    place = next_row(place);
    const std::int64_t corners = count(words_[0]);
    if (std::size_t(corners) > words_.size() - 1)
      mesh_.fail(place, "says that it has " + std::to_string(corners) + " corners: " + quoted(words_));
    ids_.clear();
    for (std::size_t i = 1; i < words_.size(); ++i) {
      if (i > std::size_t(corners)) {
        if (!parse_double(words_[i]) || i > std::size_t(corners) + 4)
          mesh_.fail(place, "has more behind its corners than a colour: " + quoted(words_));
        continue;
      }
      const std::optional<std::int64_t> id = parse_whole(words_[i]);
      if (!id) mesh_.fail(place, "has " + quoted(words_[i]) + " where a vertex index is expected");
      ids_.push_back(*id);
    }
    mesh_.face(ids_, place);
  }

  Lines lines_;
  Words words_;
  std::vector<std::int64_t> ids_;
};

// Geomview's: big-endian, four bytes a number.
class BinaryReader : OffReader {
 public:
  BinaryReader(const std::string& path, std::string_view first_word, std::string_view data)
      : OffReader(path), rest_(data) {
    keyword(first_word, 1);
  }

  MeshFile read() {
    const Place counts{"count", 0, 0};
    const std::int64_t vertices = whole(counts), faces = whole(counts);
    whole(counts);
    check_counts(vertices, faces, 0, rest_.size(), 4 * header_.values, 8);
    for (std::int64_t i = 0; i < vertices; ++i) vertex({"vertex", i, 0});
    for (std::int64_t i = 0; i < faces; ++i) face({"face", i, 0});
    if (rest_.find_first_not_of(" \t\r\n") != rest_.npos)
      mesh_.fail(0, std::to_string(rest_.size()) + " bytes more than its numbers of vertices and faces say");
    return mesh_.finish();
  }

 private:
  void vertex(const Place& place) {
    std::array<double, 3> position{};
    for (std::size_t i = 0; i < header_.values; ++i) {
      const double value = real(place);
      if (i < 3) position[i] = value;
    }
    mesh_.vertex(position, 0);
  }

  void face(const Place& place) {
    ids_.resize(length(place, "corners"));
    for (std::int64_t& id : ids_) id = whole(place);
    rest_.remove_prefix(4 * length(place, "numbers of a colour"));
    mesh_.face(ids_, place);
  }

  std::size_t length(const Place& place, const char* what) {
    const std::int64_t length = whole(place);
    if (length < 0 || std::size_t(length) > rest_.size() / 4)
      mesh_.fail(place, "says that it has " + std::to_string(length) + " " + what + ", the file has " +
                            std::to_string(rest_.size()) + " bytes left");
    return std::size_t(length);
  }

  std::int32_t whole(const Place& place) {
    if (rest_.size() < 4) mesh_.fail(place, "is cut off: the file ends before it is complete");
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(rest_[i]);
    rest_.remove_prefix(4);
    return static_cast<std::int32_t>(value);
  }

  double real(const Place& place) {
    const std::int32_t bits = whole(place);
    float value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }

  std::string_view rest_;
  std::vector<std::int64_t> ids_;
};

}  // namespace

MeshFile read_off(const std::string& path, std::string_view bytes) {
  bytes = without_mark(bytes);
  Words words;
  const std::size_t end = std::min(bytes.find('\n'), bytes.size());
  split_words(bytes.substr(0, end), words);
  if (words.size() == 2 && words[1] == "BINARY")
    return BinaryReader(path, words[0], bytes.substr(std::min(end + 1, bytes.size()))).read();
  return TextReader(path, bytes).read();
}

}  // namespace app
