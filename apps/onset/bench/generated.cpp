#include "onset/bench/generated.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "files/error.hpp"

namespace app {
namespace {

constexpr double kGap = 1.5, kFall = 2.0, kSlide = 1.0;  // edge lengths
constexpr double kRipple = 0.7;                          // height of the ripples, in edge lengths
constexpr double kWave = 12.5;                           // their length, in edge lengths: no multiple of one
constexpr std::int64_t kMostVertices = INT32_MAX;        // the library's ids are ints
constexpr double kRise = 0.5;                            // of a plate's ripples at the end, in edge lengths

// Two triangles a square of a grid of n x n, with alternating diagonals.
void add_faces(Frames& frames, int n, Eigen::Index first_vertex, Eigen::Index first_face) {
  const auto id = [&](int i, int j) {
    return static_cast<long long>(first_vertex + Eigen::Index(i) * (n + 1) + j);
  };
  Eigen::Index f = first_face;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const bool other = (i + j) % 2;
      frames.faces.row(f++) << id(i, j), id(i + 1, j), other ? id(i, j + 1) : id(i + 1, j + 1);
      frames.faces.row(f++) << id(i, j + 1), other ? id(i + 1, j) : id(i, j), id(i + 1, j + 1);
    }
}

// A grid of n x n squares of edge length 1 at height z; ripples run along a diagonal, those of odd sheets
// across it.
void add_sheet(Frames& frames, int n, int sheet, Eigen::Index first_vertex, Eigen::Index first_face) {
  const double turn = 2 * std::acos(-1.0) / kWave;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) {
      const double phase = turn * (sheet ? 0.8 * i - 0.6 * j : 0.6 * i + 0.8 * j);
      const Eigen::RowVector3d x(i, j, kGap * sheet + 0.5 * kRipple * std::sin(phase));
      const Eigen::Index v = first_vertex + Eigen::Index(i) * (n + 1) + j;
      frames.x_t0.row(v) = x / n;
      frames.x_t1.row(v) = (x + sheet * Eigen::RowVector3d(kSlide, 0.3 * kSlide, -kFall)) / n;
    }
  add_faces(frames, n, first_vertex, first_face);
}

// A flat grid, the second one shifted within the plane; ripples that grow in the step press the two on one
// another in half of the area and part them in the other. Turned, both are flat up to rounding only.
void add_plate(Frames& frames, int n, int plate, Eigen::Index first_vertex, Eigen::Index first_face) {
  const Eigen::Matrix3d turned =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const double turn = 2 * std::acos(-1.0) / kWave;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) {
      const Eigen::Vector3d x(i + 0.3 * plate, j + 0.2 * plate, 0);
      const double up = plate * kRise * std::sin(turn * (0.6 * i + 0.8 * j));
      const Eigen::Index v = first_vertex + Eigen::Index(i) * (n + 1) + j;
      frames.x_t0.row(v) = (turned * x / n).transpose();
      frames.x_t1.row(v) = (turned * (x + Eigen::Vector3d(0, 0, up)) / n).transpose();
    }
  add_faces(frames, n, first_vertex, first_face);
}

void check_size(double vertices, std::int64_t asked) {
  if (vertices >= double(kMostVertices)) throw UsageError(std::to_string(asked) + ": more vertices than ids");
}

using Edge = std::pair<long long, long long>;  // smaller id first

Edge edge_of(long long a, long long b) { return std::minmax(a, b); }

// Undirected edges of all faces with the number of their midpoint, sorted.
class Midpoints {
 public:
  Midpoints(const Faces& faces, Eigen::Index first) : first_(first) {
    edges_.reserve(std::size_t(3 * faces.rows()));
    for (Eigen::Index f = 0; f < faces.rows(); ++f)
      for (int c = 0; c < 3; ++c) edges_.push_back(edge_of(faces(f, c), faces(f, (c + 1) % 3)));
    std::sort(edges_.begin(), edges_.end());
    edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
  }
  const std::vector<Edge>& edges() const { return edges_; }
  long long of(long long a, long long b) const {
    const auto found = std::lower_bound(edges_.begin(), edges_.end(), edge_of(a, b));
    return first_ + (found - edges_.begin());
  }

 private:
  std::vector<Edge> edges_;
  Eigen::Index first_;
};

Points with_midpoints(const Points& x, const Midpoints& midpoints) {
  Points finer(x.rows() + Eigen::Index(midpoints.edges().size()), 3);
  finer.topRows(x.rows()) = x;
  Eigen::Index row = x.rows();
  for (const auto& [a, b] : midpoints.edges()) finer.row(row++) = 0.5 * (x.row(a) + x.row(b));
  return finer;
}

Frames divided(const Frames& frames) {
  const Midpoints midpoints(frames.faces, frames.x_t0.rows());
  Frames finer{with_midpoints(frames.x_t0, midpoints), with_midpoints(frames.x_t1, midpoints), {}};
  finer.faces.resize(4 * frames.faces.rows(), 3);
  for (Eigen::Index f = 0; f < frames.faces.rows(); ++f) {
    const long long a = frames.faces(f, 0), b = frames.faces(f, 1), c = frames.faces(f, 2);
    const long long ab = midpoints.of(a, b), bc = midpoints.of(b, c), ca = midpoints.of(c, a);
    finer.faces.middleRows(4 * f, 4) << a, ab, ca, b, bc, ab, c, ca, bc, ab, bc, ca;
  }
  return finer;
}

void add_still_sheet(Frames& frames, int n, int sheet, Eigen::Index first_vertex, Eigen::Index first_face) {
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) {
      const Eigen::Index v = first_vertex + Eigen::Index(i) * (n + 1) + j;
      frames.x_t0.row(v) = Eigen::RowVector3d(i, j, kGap * sheet) / n;
      frames.x_t1.row(v) = Eigen::RowVector3d(i, j, (kGap - 0.1) * sheet) / n;
    }
  add_faces(frames, n, first_vertex, first_face);
}

template <class AddSheet>
Frames two_sheets(std::int64_t triangles, const AddSheet& add) {
  const int n = std::max(1, int(std::lround(std::sqrt(double(triangles) / 4))));
  check_size(2.0 * (n + 1.0) * (n + 1.0), triangles);
  const Eigen::Index vertices = Eigen::Index(n + 1) * (n + 1), faces = Eigen::Index(2) * n * n;
  Frames frames{Points(2 * vertices, 3), Points(2 * vertices, 3), Faces(2 * faces, 3)};
  for (int sheet = 0; sheet < 2; ++sheet) add(frames, n, sheet, sheet * vertices, sheet * faces);
  return frames;
}

}  // namespace

Frames layered_cloth(std::int64_t triangles) { return two_sheets(triangles, add_sheet); }
Frames resting_plates(std::int64_t triangles) { return two_sheets(triangles, add_plate); }
Frames still_sheets(std::int64_t triangles) { return two_sheets(triangles, add_still_sheet); }

Frames refined(Frames frames, int times) {
  for (int i = 0; i < times; ++i) {
    check_size(double(frames.x_t0.rows()) + 3.0 * double(frames.faces.rows()), frames.faces.rows());
    frames = divided(frames);
  }
  return frames;
}

}  // namespace app
