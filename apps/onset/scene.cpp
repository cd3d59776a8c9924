#include "scene.hpp"

#include <stdexcept>

#include "error.hpp"

namespace app {
namespace {

onset::Mesh make_mesh(const MeshFile& file) {
  try {
    return onset::Mesh(file.positions.rows(), file.faces);
  } catch (const std::invalid_argument& e) {
    throw InputError(file.path + ": " + e.what());
  }
}

std::string corners(const MeshFile& file, Eigen::Index face) {
  std::string text = "(";
  for (int c = 0; c < 3; ++c) text += (c ? " " : "") + std::to_string(file.faces(face, c));
  return text + ")";
}

std::string counts(const char* what, Eigen::Index a, Eigen::Index b) {
  return std::to_string(a) + " against " + std::to_string(b) + " " + what;
}

// The first difference in words; empty when there is none.
std::string difference(const MeshFile& a, const MeshFile& b) {
  if (a.positions.rows() != b.positions.rows())
    return counts("vertices", a.positions.rows(), b.positions.rows());
  if (a.faces.rows() != b.faces.rows()) return counts("faces", a.faces.rows(), b.faces.rows());
  for (Eigen::Index f = 0; f < a.faces.rows(); ++f)
    if (a.faces.row(f) != b.faces.row(f))
      return "face " + std::to_string(f) + " is " + corners(a, f) + " against " + corners(b, f);
  return "";
}

}  // namespace

Scene read_scene(const std::string& path_t0, const std::string& path_t1) {
  MeshFile t0 = read_mesh(path_t0), t1 = read_mesh(path_t1);
  onset::Mesh mesh = make_mesh(t0);
  const std::string differs = difference(t0, t1);
  if (!differs.empty()) {
    make_mesh(t1);  // a face that is wrong in itself says more than a difference
    throw InputError(path_t0 + " and " + path_t1 + ": different topology: " + differs);
  }
  return {std::move(mesh), std::move(t0.positions), std::move(t1.positions)};
}

}  // namespace app
