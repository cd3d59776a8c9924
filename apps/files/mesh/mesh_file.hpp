// Reads a mesh from a file: vertices, faces, wires (edges on their own) and points.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace app {

using Faces = Eigen::Matrix<long long, Eigen::Dynamic, 3, Eigen::RowMajor>;
using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

inline std::array<double, 3> point(const Points& x, int vertex) {
  return {x(vertex, 0), x(vertex, 1), x(vertex, 2)};
}

// Each of three corners or more, one after another.
struct Polygons {
  std::vector<std::int64_t> corners;
  std::vector<std::size_t> ends;  // where in `corners` each one ends

  std::size_t size() const { return ends.size(); }
  std::size_t begin(std::size_t i) const { return i == 0 ? 0 : ends[i - 1]; }
  std::size_t corners_of(std::size_t i) const { return ends[i] - begin(i); }
};

// All in the order of the file; ids are in range, and those of one element differ.
struct MeshFile {
  std::string path;
  Points positions;  // #V x 3, finite
  Polygons polygons;
  std::vector<std::array<std::int64_t, 2>> wires;
  std::vector<std::int64_t> points;  // vertices that the file declares as points
  std::vector<std::string> notes;    // what whoever reads the result should know about how the file was taken
  bool shares_vertices = true;       // STL: false, each corner is a vertex of its own
};

// The format is taken from the extension, whatever its case: .obj, .ply, .off, .stl. Throws InputError naming
// the file, the line of a text, and the cause: missing, unreadable, another format and what converts it, a
// position that is not three finite numbers, an index out of range, rows that are too few or too many.
MeshFile read_mesh(const std::string& path);

// The same for the bytes of a file of each format; `path` is for messages.
//
// Wavefront OBJ: v, f, l, p. Normals, textures, groups and materials are skipped, as are keywords that are
// not OBJ's, with a note; curves, surfaces and calls of other files are refused.
MeshFile read_obj(const std::string& path, std::string_view text);
// PLY, ascii and binary of both endians: vertex, face, edge. Other elements are skipped, with a note;
// triangle strips are refused.
MeshFile read_ply(const std::string& path, std::string_view bytes);
// OFF, ascii and binary.
MeshFile read_off(const std::string& path, std::string_view bytes);
// STL, ascii and binary; each corner is a vertex of its own.
MeshFile read_stl(const std::string& path, std::string_view bytes);
// Which of the two, from the first bytes of a file of `size`; throws where it can be neither.
bool is_text_stl(const std::string& path, std::string_view head, std::uint64_t size);

}  // namespace app
