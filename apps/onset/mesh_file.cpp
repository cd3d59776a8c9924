#include "mesh_file.hpp"

#define CGAL_DISABLE_GMP 1  // number types that are not needed here would have to be linked
#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/OFF.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>
#include <sstream>
#include <vector>

#include "error.hpp"
#include "input_file.hpp"
#include "ply_header.hpp"

namespace app {
namespace {

using Point = CGAL::Simple_cartesian<double>::Point_3;

// CGAL sizes some of its output before it reads the values; these fill what is not read yet with what cannot
// be read, so that the place where reading stopped can be named.
struct PointList : std::vector<Point> {
  void resize(std::size_t n) {
    const double unread = std::numeric_limits<double>::quiet_NaN();
    std::vector<Point>::resize(n, Point(unread, unread, unread));
  }
};
struct Polygon : std::vector<long long> {
  static constexpr long long kUnread = std::numeric_limits<long long>::min();
  void resize(std::size_t n) { std::vector<long long>::resize(n, kUnread); }
};

struct Soup {
  PointList points;
  std::vector<Polygon> polygons;
};

[[noreturn]] void fail(const std::string& path, const std::string& cause) {
  throw InputError(path + ": " + cause);
}

std::string extension(const std::string& path) {
  std::string ext = std::filesystem::path(path).extension().string();
  std::transform(ext.begin(), ext.end(), ext.begin(), [](unsigned char c) { return std::tolower(c); });
  return ext;
}

// What CGAL says about a file, kept from the terminal.
class CapturedWords {
 public:
  CapturedWords() : cout_(std::cout.rdbuf(words_.rdbuf())), cerr_(std::cerr.rdbuf(words_.rdbuf())) {}
  ~CapturedWords() { std::cout.rdbuf(cout_), std::cerr.rdbuf(cerr_); }
  CapturedWords(const CapturedWords&) = delete;
  std::string first_line() {
    std::string line;
    std::getline(words_, line);
    return line;
  }

 private:
  std::stringstream words_;
  std::streambuf *cout_, *cerr_;
};

bool read_soup(const std::string& path, Soup& soup) {
  const auto verbose = CGAL::parameters::verbose(true);
  const std::string ext = extension(path);
  if (ext != ".ply" && ext != ".obj" && ext != ".off")
    fail(path, "unknown extension, .ply, .obj or .off expected");
  std::ifstream in = open_input(path);
  if (ext == ".ply") {
    const std::string problem = ply_header_problem(in);
    if (!problem.empty()) fail(path, problem);
    in.seekg(0);
    return CGAL::IO::read_PLY(in, soup.points, soup.polygons, verbose);
  }
  if (ext == ".obj") return CGAL::IO::read_OBJ(in, soup.points, soup.polygons, verbose);
  return CGAL::IO::read_OFF(in, soup.points, soup.polygons, verbose);
}

bool finite(const Point& p) { return std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z()); }

void check_points(const std::string& path, const Soup& soup) {
  const auto bad = std::find_if_not(soup.points.begin(), soup.points.end(), finite);
  if (bad != soup.points.end())
    fail(path, "vertex " + std::to_string(bad - soup.points.begin()) + " is not three finite numbers");
}

void check_polygons(const std::string& path, const Soup& soup) {
  const auto n = static_cast<long long>(soup.points.size());
  for (std::size_t f = 0; f < soup.polygons.size(); ++f) {
    const Polygon& polygon = soup.polygons[f];
    const std::string face = "face " + std::to_string(f), range = "[0, " + std::to_string(n) + ")";
    if (polygon.size() != 3)
      fail(path, face + " has " + std::to_string(polygon.size()) + " vertices, 3 expected");
    for (const long long id : polygon) {
      if (id == Polygon::kUnread) fail(path, face + " has a vertex index that is missing or not in " + range);
      if (id < 0 || id >= n)
        fail(path, face + " has vertex index " + std::to_string(id) + ", not in " + range);
    }
  }
}

// CGAL gave up: on a vertex, on a face, or with a reason of its own.
[[noreturn]] void explain_stop(const std::string& path, const Soup& soup, const std::string& reason) {
  check_points(path, soup);
  check_polygons(path, soup);
  const std::string vertices = std::to_string(soup.points.size()),
                    faces = std::to_string(soup.polygons.size());
  const bool at_vertex = reason.empty() ? soup.polygons.empty() : reason.find("vertex") != reason.npos;
  if (at_vertex)
    fail(path, "vertex " + vertices + " is not three finite numbers, or the file ends before it");
  fail(path, "cannot be read beyond " + vertices + " vertices and " + faces + " faces" +
                 (reason.empty() ? "" : ": " + reason));
}

MeshFile to_mesh(const std::string& path, const Soup& soup) {
  MeshFile mesh{path, Points(soup.points.size(), 3), Faces(soup.polygons.size(), 3)};
  for (std::size_t v = 0; v < soup.points.size(); ++v)
    mesh.positions.row(v) << soup.points[v].x(), soup.points[v].y(), soup.points[v].z();
  for (std::size_t f = 0; f < soup.polygons.size(); ++f)
    for (int c = 0; c < 3; ++c) mesh.faces(f, c) = soup.polygons[f][c];
  return mesh;
}

}  // namespace

MeshFile read_mesh(const std::string& path) {
  Soup soup;
  bool complete = false;
  std::string reason;
  try {
    CapturedWords words;
    complete = read_soup(path, soup);
    reason = words.first_line();
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& e) {  // a count that no memory can hold, say
    fail(path, std::string("cannot be read: ") + e.what());
  }
  if (!complete) explain_stop(path, soup, reason);
  check_points(path, soup);
  check_polygons(path, soup);
  if (soup.polygons.empty()) fail(path, "no faces");
  return to_mesh(path, soup);
}

}  // namespace app
