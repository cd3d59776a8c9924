#include "tests/in_plane/support/plane_scenes.hpp"

#include <cmath>

namespace onset::tests {
namespace {

PlanePoint point_of(const Eigen::MatrixXd& x, int v) { return {x(v, 0), x(v, 1)}; }

bool share(const Eigen::MatrixXi& edges, int v, int e) { return edges(e, 0) == v || edges(e, 1) == v; }

}  // namespace

// Each body is a star around the middle of a cell of its own, with angles in order.
PlaneScene polygons(int bodies, double speed, scenes::Random& random, double scale) {
  PlaneScene s;
  std::vector<PlanePoint> t0, t1;
  std::vector<std::array<int, 2>> edges;
  const int side = int(std::ceil(std::sqrt(double(bodies))));
  for (int b = 0; b < bodies; ++b) {
    const int corners = scenes::integer(random, 3, 9), first = int(t0.size());
    const bool closed = scenes::coin(random);
    const double spin = scenes::uniform(random, -1, 1), grow = scenes::uniform(random, -0.3, 0.3);
    const PlanePoint middle{double(b % side), double(b / side)},
        drift{scenes::uniform(random, -speed, speed), scenes::uniform(random, -speed, speed)};
    for (int k = 0; k < corners; ++k) {
      const double angle = 6.283 * (k + 0.3 * scenes::unit(random)) / corners;
      const double r = scenes::uniform(random, 0.1, 0.45);
      const double turned = angle + spin * speed, length = r * (1 + grow * speed);
      t0.push_back({middle[0] + r * std::cos(angle), middle[1] + r * std::sin(angle)});
      t1.push_back({middle[0] + drift[0] + length * std::cos(turned) + speed * 0.2 * scenes::unit(random),
                    middle[1] + drift[1] + length * std::sin(turned) + speed * 0.2 * scenes::unit(random)});
      if (k > 0) edges.push_back({first + k - 1, first + k});
    }
    if (closed) edges.push_back({first, first + corners - 1});
  }
  s.x_t0.resize(Eigen::Index(t0.size()), 2), s.x_t1.resize(Eigen::Index(t0.size()), 2);
  for (std::size_t v = 0; v < t0.size(); ++v)
    for (std::size_t k = 0; k < 2; ++k)
      s.x_t0(Eigen::Index(v), Eigen::Index(k)) = scale * t0[v][k],
                              s.x_t1(Eigen::Index(v), Eigen::Index(k)) = scale * t1[v][k];
  s.edges = edge_matrix(edges);
  return s;
}

VertexEdgeQuery query_of(const PlaneScene& s, int v, int e) {
  const int a = s.edges(e, 0), b = s.edges(e, 1);
  return {{point_of(s.x_t0, v), point_of(s.x_t0, a), point_of(s.x_t0, b)},
          {point_of(s.x_t1, v), point_of(s.x_t1, a), point_of(s.x_t1, b)}};
}

std::map<std::array<int, 2>, PlaneTruth> contacts_of(const PlaneScene& s) {
  std::map<std::array<int, 2>, PlaneTruth> found;
  for (int v = 0; v < s.x_t0.rows(); ++v)
    for (int e = 0; e < s.edges.rows(); ++e) {
      if (share(s.edges, v, e)) continue;
      const VertexEdgeQuery q = query_of(s, v, e);
      bool apart = false;  // by the boxes of the whole motion
      for (std::size_t k = 0; k < 2; ++k) {
        const auto [lo, hi] = std::minmax({q.t0[1][k], q.t0[2][k], q.t1[1][k], q.t1[2][k]});
        apart = apart || std::max(q.t0[0][k], q.t1[0][k]) < lo || std::min(q.t0[0][k], q.t1[0][k]) > hi;
      }
      if (apart) continue;
      if (const PlaneTruth truth = plane_truth(q); truth.collides) found[{v, e}] = truth;
    }
  return found;
}

bool any_common_point(const Eigen::MatrixXd& x, const Eigen::MatrixXi& edges) {
  for (int v = 0; v < x.rows(); ++v)
    for (int e = 0; e < edges.rows(); ++e)
      if (!share(edges, v, e) && touch(point_of(x, v), point_of(x, edges(e, 0)), point_of(x, edges(e, 1))))
        return true;
  for (int e = 0; e < edges.rows(); ++e)
    for (int f = 0; f < e; ++f) {
      if (share(edges, edges(f, 0), e) || share(edges, edges(f, 1), e)) continue;
      if (edges_meet(point_of(x, edges(e, 0)), point_of(x, edges(e, 1)), point_of(x, edges(f, 0)),
                     point_of(x, edges(f, 1))))
        return true;
    }
  return false;
}

}  // namespace onset::tests
