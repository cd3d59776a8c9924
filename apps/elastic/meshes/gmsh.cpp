#include "elastic/meshes/gmsh.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <unordered_map>

#include "files/error.hpp"
#include "files/input.hpp"
#include "files/text_lines.hpp"

namespace elastic {
namespace {

constexpr std::int64_t kTetrahedron = 4;  // Gmsh's number of the element
constexpr double kLargest = 1e100;        // of a coordinate

class Reader {
 public:
  explicit Reader(const std::string& path) : lines_(path) {}

  TetMesh read() {
    while (lines_.next(line_)) {
      if (line_ == "$MeshFormat") read_format();
      if (line_ == "$Nodes") is_4() ? read_nodes_4() : read_nodes_2();
      if (line_ == "$Elements") is_4() ? read_elements_4() : read_elements_2();
    }
    if (mesh_.tetrahedra.empty()) lines_.fail("no tetrahedra");
    return std::move(mesh_);
  }

 private:
  bool is_4() {
    if (version_.empty()) lines_.fail("$MeshFormat expected first");
    return version_ == "4.1";
  }

  // The words of the next line, at least so many.
  void next(std::size_t least) {
    if (!lines_.next(line_)) lines_.fail("the file ends too early");
    app::split_words(line_, words_);
    if (words_.size() < least) lines_.fail(std::to_string(least) + " numbers expected");
  }
  std::int64_t whole(std::size_t word) {
    const auto value = app::parse_whole(words_[word]);
    if (!value) lines_.fail("a whole number expected, not " + app::quoted(words_[word]));
    return *value;
  }
  Vec3 point(std::size_t word) {
    Vec3 p;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto value = app::parse_double(words_[word + a]);
      if (!value || !(std::fabs(*value) <= kLargest))
        lines_.fail("a coordinate expected, not " + app::quoted(words_[word + a]));
      p[Eigen::Index(a)] = *value;
    }
    return p;
  }
  void add_node(std::int64_t tag, const Vec3& p) {
    if (!nodes_.try_emplace(tag, p).second) lines_.fail("node " + std::to_string(tag) + " is there twice");
  }

  void read_format() {
    next(3);
    version_ = std::string(words_[0]);
    if (version_ == "2") version_ = "2.2";
    if (version_ != "2.2" && version_ != "4.1")
      lines_.fail("MSH 2.2 or 4.1 expected, not " + app::quoted(words_[0]));
    if (whole(1) != 0) lines_.fail("an ascii file expected");
  }

  void read_nodes_2() {
    next(1);
    for (std::int64_t left = whole(0); left > 0; --left) {
      next(4);
      add_node(whole(0), point(1));
    }
  }
  void read_nodes_4() {
    next(4);
    for (std::int64_t blocks = whole(0); blocks > 0; --blocks) {
      next(4);
      std::vector<std::int64_t> tags;
      for (std::int64_t left = whole(3); left > 0; --left) {
        next(1);
        tags.push_back(whole(0));
      }
      for (const std::int64_t tag : tags) {
        next(3);
        add_node(tag, point(0));
      }
    }
  }

  void read_elements_2() {
    next(1);
    for (std::int64_t left = whole(0); left > 0; --left) {
      next(3);
      const std::int64_t tags = whole(2);
      if (whole(1) != kTetrahedron) continue;
      if (tags < 0 || std::uint64_t(tags) + 7 != words_.size()) lines_.fail("four nodes expected");
      add_tetrahedron(std::size_t(tags) + 3);
    }
  }
  void read_elements_4() {
    next(4);
    for (std::int64_t blocks = whole(0); blocks > 0; --blocks) {
      next(4);
      const bool wanted = whole(2) == kTetrahedron;
      for (std::int64_t left = whole(3); left > 0; --left) {
        next(wanted ? 5 : 1);
        if (wanted) add_tetrahedron(1);
      }
    }
  }
  void add_tetrahedron(std::size_t word) {
    Tetrahedron t;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::int64_t tag = whole(word + i);
      const auto node = nodes_.find(tag);
      if (node == nodes_.end()) lines_.fail("there is no node " + std::to_string(tag));
      const auto [found, is_new] = ids_.try_emplace(tag, int(mesh_.points.size()));
      if (is_new) mesh_.points.push_back(node->second);
      t[i] = found->second;
    }
    const auto& p = mesh_.points;
    const Vec3 a = p[std::size_t(t[0])], b = p[std::size_t(t[1])], c = p[std::size_t(t[2])],
               d = p[std::size_t(t[3])];
    const double volume = (b - a).cross(c - a).dot(d - a);
    if (!(std::fabs(volume) > 0)) lines_.fail("a tetrahedron without volume");
    if (volume < 0) std::swap(t[2], t[3]);
    mesh_.tetrahedra.push_back(t);
  }

  app::InputLines lines_;
  std::string_view line_;
  std::vector<std::string_view> words_;
  std::string version_;
  std::unordered_map<std::int64_t, Vec3> nodes_;
  std::unordered_map<std::int64_t, int> ids_;
  TetMesh mesh_;
};

}  // namespace

TetMesh read_msh(const std::string& path) { return Reader(path).read(); }

}  // namespace elastic
