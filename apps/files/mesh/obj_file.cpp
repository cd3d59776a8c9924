// tinyobjloader 2.0 was tried in this place. Its numbers are approximate (two thirds of random doubles come
// back changed), it wraps and truncates indices, and it does not know of continued lines: all that it would
// be asked for had to be checked, or done, before.
#include <algorithm>
#include <array>
#include <utility>

#include "files/mesh/mesh_builder.hpp"
#include "files/mesh/mesh_file.hpp"
#include "files/text_lines.hpp"

namespace app {
namespace {

using Words = std::vector<std::string_view>;

template <class List>
bool has(const List& list, std::string_view word) {
  return std::find(std::begin(list), std::end(list), word) != std::end(list);
}

// What says how a mesh looks, or belongs to what is refused anyhow.
constexpr std::string_view kLooks[] = {
    "vt",     "vn",       "g",      "s",          "o",         "mg",    "usemtl", "mtllib",
    "usemap", "maplib",   "bevel",  "c_interp",   "vp",        "lod",   "step",   "deg",
    "bmat",   "d_interp", "cstype", "shadow_obj", "trace_obj", "ctech", "parm",   "trim",
    "hole",   "scrv",     "sp",     "stech",      "end",       "con",   "res"};
// Shapes that are no polygons, and other files.
constexpr std::string_view kOther[] = {"curv", "curv2", "surf", "bzp", "bsp", "cdc", "cdp", "call", "csh"};
// Only these are continued on the next line: a name or comment that ends in '\' is none of our business.
constexpr std::string_view kElements[] = {"v", "f", "fo", "l", "p"};

class ObjReader {
 public:
  ObjReader(const std::string& path, std::string_view text) : mesh_(path, 1), lines_(without_mark(text)) {}

  MeshFile read() {
    std::string_view line;
    while (lines_.next(line)) {
      number_ = lines_.number();
      split_words(line, words_);
      if (words_.empty()) continue;
      if (has(kElements, words_[0])) join();
      statement();
    }
    if (skipped_ > 0)
      mesh_.note("skipped " + counted(std::size_t(skipped_), "line") +
                 " with keywords that are not OBJ's:" + keywords_);
    return mesh_.finish();
  }

 private:
  // Appends the words of the lines that continue this one.
  void join() {
    std::string_view line;
    Words more;
    while (words_.back().back() == '\\') {
      words_.back().remove_suffix(1);
      if (words_.back().empty()) words_.pop_back();
      if (!lines_.next(line)) return;
      split_words(line, more);
      words_.insert(words_.end(), more.begin(), more.end());
      if (more.empty()) return;
    }
  }

  void statement() {
    const std::string_view keyword = words_[0];
    if (keyword == "v") return vertex();
    if (keyword == "f" || keyword == "fo") return face();
    if (keyword == "l") return wire();
    if (keyword == "p") return points();
    if (has(kLooks, keyword)) return;
    if (has(kOther, keyword))
      mesh_.fail(number_, quoted(keyword) + " is not read: export polygons, in one file");
    if (std::string_view("0123456789+-.").find(keyword[0]) != keyword.npos)
      mesh_.fail(number_, "a line starts with " + quoted(keyword) + ", a keyword expected");
    skip(keyword);
  }

  void skip(std::string_view keyword) {
    constexpr std::size_t kNamed = 10;
    ++skipped_;
    if (named_.size() >= kNamed || has(named_, keyword)) return;
    named_.emplace_back(keyword);
    keywords_.append(" ").append(quoted(keyword)).append(named_.size() == kNamed ? " ..." : "");
  }

  // x y z, then nothing, a weight, a colour, or both; or x y in all of them, for z = 0.
  void vertex() {
    const std::size_t count = words_.size() - 1;
    const Place place{"vertex", mesh_.vertices(), number_};
    std::array<double, 3> position{};
    const Words text(words_.begin() + 1, words_.end());
    for (std::size_t i = 0; i < count; ++i) {
      const std::optional<double> value = parse_double(text[i]);
      if (!value) mesh_.fail(place, "is not three finite numbers: " + quoted(text));
      if (i < 3) position[i] = *value;
    }
    const bool flat = count == 2;  // all are, or one has lost a number
    if ((!flat && count != 3 && count != 4 && count != 6 && count != 7) ||
        (mesh_.vertices() > 0 && flat != flat_))
      mesh_.fail(place, "has " + std::to_string(count) + " numbers, " + (flat_ ? "2" : "3") +
                            " expected: " + quoted(text));
    flat_ = flat;
    mesh_.vertex(position, number_, quoted(text));
  }

  void face() {
    const Place place{"face", faces_++, number_};
    mesh_.face(ids(place), place);
  }

  void wire() {
    const Place place{"wire", wires_++, number_};
    mesh_.polyline(ids(place), place);
  }

  void points() {
    const std::vector<std::int64_t>& list = ids({"point", points_, number_});
    if (list.empty()) mesh_.fail({"point", points_, number_}, "has no vertices");
    for (const std::int64_t id : list) mesh_.point(id, {"point", points_++, number_});
  }

  // Corners are v, v/vt, v//vn or v/vt/vn.
  const std::vector<std::int64_t>& ids(const Place& place) {
    ids_.clear();
    for (std::size_t i = 1; i < words_.size(); ++i) ids_.push_back(corner(words_[i], place));
    return ids_;
  }

  std::int64_t corner(std::string_view word, const Place& place) {
    const std::string_view index = word.substr(0, word.find('/'));
    const std::int64_t value = whole(index, word, place);
    std::string_view rest = word.substr(index.size());
    for (int part = 0; !rest.empty(); ++part) {
      rest.remove_prefix(1);
      const std::string_view other = rest.substr(0, rest.find('/'));
      if (part == 2) mesh_.fail(place, "has more than three indices in " + quoted(word));
      if (!other.empty()) whole(other, word, place);
      rest.remove_prefix(other.size());
    }
    if (value > 0) return value - 1;
    if (value == 0) mesh_.fail(place, "has vertex index 0; the first vertex is 1");
    if (value < -mesh_.vertices())
      mesh_.fail(place, "has vertex index " + std::string(index) + ", but only " +
                            std::to_string(mesh_.vertices()) + " vertices come before it");
    return mesh_.vertices() + value;
  }

  std::int64_t whole(std::string_view index, std::string_view word, const Place& place) {
    const std::optional<std::int64_t> value = parse_whole(index);
    if (!value) mesh_.fail(place, "has " + quoted(word) + " where a vertex index is expected");
    return *value;
  }

  MeshBuilder mesh_;
  Lines lines_;
  std::size_t number_ = 0;  // of the line that the statement starts on
  Words words_;
  std::vector<std::int64_t> ids_;
  std::int64_t faces_ = 0, wires_ = 0, points_ = 0, skipped_ = 0;
  std::vector<std::string> named_;
  std::string keywords_;
  bool flat_ = false;  // vertices have two numbers
};

}  // namespace

MeshFile read_obj(const std::string& path, std::string_view text) { return ObjReader(path, text).read(); }

}  // namespace app
