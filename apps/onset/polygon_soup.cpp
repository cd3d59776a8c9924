#include "polygon_soup.hpp"

#define CGAL_DISABLE_GMP 1  // number types that are not needed here would have to be linked
#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/OFF.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <sstream>

#include "error.hpp"
#include "input_file.hpp"
#include "ply_header.hpp"

namespace app {
namespace {

using Point = CGAL::Simple_cartesian<double>::Point_3;

// CGAL sizes what it reads from OFF before it has the values. What is not read yet holds what no value can
// be, so that the place where reading stopped can be named; and more elements than the file has bytes would
// only fill the memory.
template <class T>
struct List : std::vector<T> {
  explicit List(std::size_t bytes) : limit(bytes) {}
  void resize(std::size_t n) {
    if (n > limit) throw InputError("it says that it has " + std::to_string(n) + " elements");
    std::vector<T>::resize(n, unread(T()));
  }
  static Point unread(const Point&) { return Point(NAN, NAN, NAN); }
  template <class U>
  static U unread(const U& empty) {
    return empty;
  }
  std::size_t limit;
};
struct Polygon : std::vector<long long> {
  void resize(std::size_t n) { std::vector<long long>::resize(n, kUnreadIndex); }
};

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

bool read(const std::string& ext, std::istream& in, List<Point>& points, List<Polygon>& polygons) {
  const auto verbose = CGAL::parameters::verbose(true);
  if (ext == ".ply") return CGAL::IO::read_PLY(in, points, polygons, verbose);
  if (ext == ".obj") return CGAL::IO::read_OBJ(in, points, polygons, verbose);
  return CGAL::IO::read_OFF(in, points, polygons, verbose);
}

void check_header(const std::string& path, std::istream& in) {
  const std::string problem = ply_header_problem(in);
  if (!problem.empty()) throw InputError(path + ": " + problem);
  in.seekg(0);
}

}  // namespace

std::string extension(const std::string& path) {
  std::string ext = std::filesystem::path(path).extension().string();
  std::transform(ext.begin(), ext.end(), ext.begin(), [](unsigned char c) { return std::tolower(c); });
  return ext;
}

PolygonSoup read_polygon_soup(const std::string& path) {
  std::ifstream in = open_input(path);
  const std::string ext = extension(path);
  if (ext != ".ply" && ext != ".obj" && ext != ".off")
    throw InputError(path + ": unknown extension, .ply, .obj or .off expected");
  if (ext == ".ply") check_header(path, in);
  PolygonSoup soup;
  const std::size_t bytes = std::filesystem::file_size(path);
  List<Point> points(bytes);
  List<Polygon> polygons(bytes);
  try {
    CapturedWords words;
    soup.complete = read(ext, in, points, polygons);
    soup.reason = words.first_line();
  } catch (const std::exception& e) {  // a count that no memory can hold, say
    throw InputError(path + ": cannot be read: " + e.what());
  }
  soup.points.reserve(points.size());
  for (const Point& p : points) soup.points.push_back({p.x(), p.y(), p.z()});
  soup.polygons.assign(std::make_move_iterator(polygons.begin()), std::make_move_iterator(polygons.end()));
  return soup;
}

}  // namespace app
