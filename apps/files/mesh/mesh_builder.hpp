// Collects what the readers of mesh files find, and checks it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "files/mesh/mesh_file.hpp"

namespace app {

// Where an element stands in its file, for messages: "face 3 of line 12".
struct Place {
  const char* what;  // "face", "wire", "point", "vertex"
  std::int64_t row;  // from 0, among those of its kind
  std::size_t line;  // 0: the file has no lines
};

class MeshBuilder {
 public:
  // `base`: the index of the first vertex in the file.
  MeshBuilder(std::string path, std::int64_t base);

  // Throws InputError for what is not finite; `text`: what the file says, in quotes, may be empty.
  void vertex(const std::array<double, 3>& position, std::size_t line, const std::string& text = "");
  // Ids from 0, which need not have been read yet. One corner makes a point, two a wire. Throw InputError for
  // an element that repeats a vertex, has none, or has a negative id.
  void face(const std::vector<std::int64_t>& ids, const Place& place);
  void polyline(const std::vector<std::int64_t>& ids, const Place& place);
  void point(std::int64_t id, const Place& place);

  void note(const std::string& text) { mesh_.notes.push_back(text); }
  void corners_are_vertices() { mesh_.shares_vertices = false; }
  std::int64_t vertices() const { return std::int64_t(positions_.size()); }

  // The mesh, all indices checked. Without any element, every vertex is a point.
  MeshFile finish();

  [[noreturn]] void fail(std::size_t line, const std::string& cause) const;
  [[noreturn]] void fail(const Place& place, const std::string& cause) const;

 private:
  struct Forward {  // an id of a vertex that had not been read, and larger than all such before it
    std::int64_t id;
    Place place;
  };
  void check(std::int64_t id, const Place& place);
  void check_different(const std::vector<std::int64_t>& ids, const Place& place);
  [[noreturn]] void out_of_range(std::int64_t id, const Place& place) const;

  MeshFile mesh_;
  std::int64_t base_;
  std::vector<std::array<double, 3>> positions_;
  std::vector<Forward> forward_;
  std::vector<std::int64_t> sorted_;
};

}  // namespace app
