#include "files/scene/triangulate.hpp"

#include <cmath>
#include <cstddef>

#include "files/error.hpp"

namespace app {
namespace {

using Point2 = std::array<double, 2>;

// > 0: a b c turn left. What rounding does to it changes which diagonals are taken, no more.
double turn(const Point2& a, const Point2& b, const Point2& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

// One polygon at a time, its corners numbered from 0.
class EarCutter {
 public:
  explicit EarCutter(const MeshFile& file) : file_(file) {}

  // Calls add(i, j, k) for each triangle.
  template <class Add>
  void cut(std::size_t polygon, Add&& add) {
    flatten(polygon);
    ring_.resize(corners_.size());
    for (std::size_t i = 0; i < ring_.size(); ++i) ring_[i] = i;
    while (ring_.size() > 3) {
      const std::size_t ear = find_ear(polygon);
      add(at(ear + ring_.size() - 1), at(ear), at(ear + 1));
      ring_.erase(ring_.begin() + std::ptrdiff_t(ear));
    }
    add(ring_[0], ring_[1], ring_[2]);
  }

 private:
  std::size_t at(std::size_t i) const { return ring_[i % ring_.size()]; }

  // Without the axis along which its normal (Newell's) is longest, so that it turns left.
  void flatten(std::size_t polygon) {
    const std::size_t begin = file_.polygons.begin(polygon), n = file_.polygons.corners_of(polygon);
    const auto row = [&](std::size_t i) {
      return file_.positions.row(file_.polygons.corners[begin + i % n]);
    };
    std::array<double, 3> normal{};
    for (std::size_t i = 0; i < n; ++i) {
      const auto a = row(i) - row(0), b = row(i + 1) - row(0);
      for (int c = 0; c < 3; ++c)
        normal[std::size_t(c)] += a((c + 1) % 3) * b((c + 2) % 3) - a((c + 2) % 3) * b((c + 1) % 3);
    }
    int axis = 0;
    for (int c = 1; c < 3; ++c)
      if (std::abs(normal[std::size_t(c)]) > std::abs(normal[std::size_t(axis)])) axis = c;
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    corners_.resize(n);
    for (std::size_t i = 0; i < n; ++i)
      corners_[i] =
          normal[std::size_t(axis)] < 0 ? Point2{row(i)(v), row(i)(u)} : Point2{row(i)(u), row(i)(v)};
  }

  // The first one with area and without other corners in it; else, where the polygon crosses itself or has no
  // area, the first one with area, or the first.
  std::size_t find_ear(std::size_t polygon) {
    std::size_t convex = ring_.size();
    for (std::size_t i = 0; i < ring_.size(); ++i) {
      spend(polygon, 1);
      const Point2 &a = corners_[at(i + ring_.size() - 1)], &b = corners_[ring_[i]], &c = corners_[at(i + 1)];
      if (!(turn(a, b, c) > 0)) continue;
      if (convex == ring_.size()) convex = i;
      if (is_empty(polygon, a, b, c)) return i;
    }
    return convex == ring_.size() ? 0 : convex;
  }

  bool is_empty(std::size_t polygon, const Point2& a, const Point2& b, const Point2& c) {
    spend(polygon, ring_.size());
    for (const std::size_t other : ring_) {
      const Point2& p = corners_[other];
      const bool outside = turn(a, b, p) < 0 || turn(b, c, p) < 0 || turn(c, a, p) < 0;
      if (!outside && p != a && p != b && p != c) return false;
    }
    return true;
  }

  void spend(std::size_t polygon, std::size_t tests) {
    constexpr std::size_t kMost = 200'000'000;  // half a second: what is refused is refused soon
    spent_ += tests;
    if (spent_ > kMost)
      throw InputError(file_.path + ": the polygon of face " + std::to_string(polygon) + " has " +
                       std::to_string(corners_.size()) +
                       " corners, too many to cut into triangles: write triangles");
  }

  const MeshFile& file_;
  std::vector<Point2> corners_;
  std::vector<std::size_t> ring_;  // those that are left
  std::size_t spent_ = 0;
};

}  // namespace

Faces triangulate(const MeshFile& file) {
  const Polygons& polygons = file.polygons;
  const std::size_t triangles = polygons.corners.size() - 2 * polygons.size();
  Faces faces(Eigen::Index(triangles), 3);
  Eigen::Index row = 0;
  EarCutter cutter(file);
  for (std::size_t p = 0; p < polygons.size(); ++p) {
    const std::int64_t* corners = polygons.corners.data() + polygons.begin(p);
    const auto add = [&](std::size_t i, std::size_t j, std::size_t k) {
      faces.row(row++) << corners[i], corners[j], corners[k];
    };
    if (polygons.corners_of(p) == 3)
      add(0, 1, 2);
    else
      cutter.cut(p, add);
  }
  return faces;
}

}  // namespace app
