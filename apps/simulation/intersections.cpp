#include "simulation/intersections.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>

namespace simulation {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Points = std::vector<Kernel::Point_3>;
using Face = std::array<int, 3>;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, int>;

// The face with the vertices that `other` has too in front; their number.
int shared_first(Face& face, const Face& other) {
  const auto shared = [&](int v) { return std::find(other.begin(), other.end(), v) != other.end(); };
  return int(std::stable_partition(face.begin(), face.end(), shared) - face.begin());
}

bool meet(const Points& p, Face f, Face g) {
  const Face original = f;
  const int shared = shared_first(f, g);
  shared_first(g, original);
  const auto point = [&](int v) { return p[std::size_t(v)]; };
  const auto triangle = [&](const Face& t) {
    return Kernel::Triangle_3(point(t[0]), point(t[1]), point(t[2]));
  };
  if (shared == 0) return CGAL::do_intersect(triangle(f), triangle(g));
  if (shared == 1)  // beyond the shared vertex they meet only where an opposite edge meets the other face
    return CGAL::do_intersect(Kernel::Segment_3(point(f[1]), point(f[2])), triangle(g)) ||
           CGAL::do_intersect(Kernel::Segment_3(point(g[1]), point(g[2])), triangle(f));
  // Beyond a shared edge they meet only where one is folded flat onto the other.
  return shared == 3 ||
         (CGAL::coplanar(point(f[0]), point(f[1]), point(f[2]), point(g[2])) &&
          CGAL::coplanar_orientation(point(f[0]), point(f[1]), point(f[2]), point(g[2])) == CGAL::POSITIVE);
}

}  // namespace

std::optional<std::pair<int, int>> faces_that_meet(const Vector& x, const std::vector<Face>& faces) {
  Points points;
  for (Eigen::Index v = 0; v < x.size(); v += 3) points.emplace_back(x[v], x[v + 1], x[v + 2]);
  std::vector<Box> boxes;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    CGAL::Bbox_3 box;
    for (const int v : faces[f]) box += points[std::size_t(v)].bbox();
    boxes.emplace_back(box, int(f));
  }
  std::optional<std::pair<int, int>> first;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
    const std::pair<int, int> pair = std::minmax(a.info(), b.info());
    if (first && *first <= pair) return;
    if (meet(points, faces[std::size_t(pair.first)], faces[std::size_t(pair.second)])) first = pair;
  });
  return first;
}

std::optional<std::pair<int, int>> vertex_behind_plane(const Vector& x,
                                                       const std::vector<onset::Plane>& planes) {
  for (std::size_t p = 0; p < planes.size(); ++p) {
    const auto& n = planes[p].normal;
    const Kernel::Plane_3 exact(n[0], n[1], n[2], -planes[p].offset);
    for (Eigen::Index v = 0; v < x.size(); v += 3)
      if (exact.oriented_side(Kernel::Point_3(x[v], x[v + 1], x[v + 2])) != CGAL::ON_POSITIVE_SIDE)
        return std::pair(int(v / 3), int(p));
  }
  return {};
}

std::string intersection_in_words(const Vector& x, const std::vector<Face>& faces,
                                  const std::vector<onset::Plane>& planes) {
  if (const auto pair = faces_that_meet(x, faces))
    return "faces " + std::to_string(pair->first) + " and " + std::to_string(pair->second);
  if (const auto pair = vertex_behind_plane(x, planes))
    return "vertex " + std::to_string(pair->first) + " and plane " + std::to_string(pair->second);
  return {};
}

}  // namespace simulation
