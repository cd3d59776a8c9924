#include "mesh_file.hpp"

#include <algorithm>
#include <cmath>

#include "error.hpp"
#include "polygon_soup.hpp"

namespace app {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& cause) {
  throw InputError(path + ": " + cause);
}

std::ptrdiff_t first_bad_point(const PolygonSoup& soup) {  // the number of points when there is none
  const auto finite = [](const std::array<double, 3>& p) {
    return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
  };
  return std::find_if_not(soup.points.begin(), soup.points.end(), finite) - soup.points.begin();
}

void check_points(const std::string& path, const PolygonSoup& soup) {
  const std::ptrdiff_t bad = first_bad_point(soup);
  if (bad < std::ptrdiff_t(soup.points.size()))
    fail(path, "vertex " + std::to_string(bad) + " is not three finite numbers");
}

void check_polygons(const std::string& path, const PolygonSoup& soup) {
  const auto n = static_cast<long long>(soup.points.size());
  const std::string range = "[0, " + std::to_string(n) + ")";
  for (std::size_t f = 0; f < soup.polygons.size(); ++f) {
    const std::vector<long long>& polygon = soup.polygons[f];
    const std::string face = "face " + std::to_string(f), corners = std::to_string(polygon.size());
    if (polygon.empty()) fail(path, face + " has no vertices, or the file ends before it");
    if (polygon.size() != 3) fail(path, face + " has " + corners + " vertices, 3 expected");
    for (const long long index : polygon) {
      const bool unread = index == kUnreadIndex;
      if (unread) fail(path, face + " has a vertex index that is missing or not in " + range);
      if (index < 0 || index >= n)
        fail(path, face + " has vertex index " + std::to_string(index) + ", not in " + range);
    }
  }
}

// CGAL gave up on an OFF file, for which it sizes everything first, and zeroes the vertex that it fails on.
[[noreturn]] void explain_off_stop(const std::string& path, const PolygonSoup& soup) {
  if (soup.points.empty()) fail(path, "cannot be read: no vertices");
  const std::ptrdiff_t unread = first_bad_point(soup), points = std::ptrdiff_t(soup.points.size());
  const bool no_face = soup.polygons.empty() || soup.polygons[0].empty();
  if (unread < points || no_face)
    fail(path, "vertex " + std::to_string(std::max<std::ptrdiff_t>(unread, 1) - 1) +
                   " is not three finite numbers" + (unread == points ? ", or face 0 is cut off" : ""));
  check_polygons(path, soup);
  fail(path, "cannot be read beyond its faces");
}

// CGAL gave up: on a vertex, on a face, or with a reason of its own.
[[noreturn]] void explain_stop(const std::string& path, const PolygonSoup& soup) {
  if (extension(path) == ".off") explain_off_stop(path, soup);
  check_points(path, soup);
  check_polygons(path, soup);
  const std::string vertices = std::to_string(soup.points.size());
  const std::string faces = std::to_string(soup.polygons.size());
  const bool at_vertex =
      soup.reason.empty() ? soup.polygons.empty() : soup.reason.find("vertex") != std::string::npos;
  if (at_vertex)
    fail(path, "vertex " + vertices + " is not three finite numbers, or the file ends before it");
  const std::string reason = soup.reason.empty() ? "" : ": " + soup.reason;
  fail(path, "cannot be read beyond " + vertices + " vertices and " + faces + " faces" + reason);
}

MeshFile to_mesh(const std::string& path, const PolygonSoup& soup) {
  MeshFile mesh{path, Points(soup.points.size(), 3), Faces(soup.polygons.size(), 3)};
  for (std::size_t v = 0; v < soup.points.size(); ++v)
    for (int c = 0; c < 3; ++c) mesh.positions(v, c) = soup.points[v][c];
  for (std::size_t f = 0; f < soup.polygons.size(); ++f)
    for (int c = 0; c < 3; ++c) mesh.faces(f, c) = soup.polygons[f][c];
  return mesh;
}

}  // namespace

MeshFile read_mesh(const std::string& path) {
  const PolygonSoup soup = read_polygon_soup(path);
  if (!soup.complete) explain_stop(path, soup);
  check_points(path, soup);
  check_polygons(path, soup);
  if (soup.polygons.empty()) fail(path, "no faces");
  return to_mesh(path, soup);
}

}  // namespace app
