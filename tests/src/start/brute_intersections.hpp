// Every edge and face of a mesh, in exact arithmetic that shares nothing with the library.
#pragma once

#include <Eigen/Core>
#include <onset/intersections.hpp>
#include <tuple>
#include <vector>

#include "tests/oracle/arithmetic/rational.hpp"
#include "tests/oracle/edge_face.hpp"

namespace onset::tests {

struct Found {
  int edge, face;
  IntersectionKind kind;
  bool operator==(const Found& o) const {
    return std::tie(edge, face, kind) == std::tie(o.edge, o.face, o.kind);
  }
};

inline bool share_vertex(const std::array<int, 2>& e, const std::array<int, 3>& f) {
  for (const int v : e)
    for (const int w : f)
      if (v == w) return true;
  return false;
}

template <class Q>
std::optional<IntersectionKind> exact_kind(const Eigen::MatrixXd& x, const std::array<int, 2>& e,
                                           const std::array<int, 3>& f) {
  const auto at = [&](int v) {
    return oracle::Vector<Q>{static_cast<Q>(x(v, 0)), static_cast<Q>(x(v, 1)), static_cast<Q>(x(v, 2))};
  };
  return oracle::edge_face<Q>({at(e[0]), at(e[1])}, {at(f[0]), at(f[1]), at(f[2])});
}

// Those without a common vertex; `lets(edge, face)` may leave out more.
template <class Q = oracle::Rational, class Lets>
std::vector<Found> brute_intersections(const Mesh& mesh, const Eigen::MatrixXd& x, Lets&& lets) {
  std::vector<Found> all;
  for (int e = 0; e < mesh.num_edges(); ++e)
    for (int f = 0; f < mesh.num_faces(); ++f)
      if (!share_vertex(mesh.edge(e), mesh.face(f)) && lets(e, f))
        if (const auto kind = exact_kind<Q>(x, mesh.edge(e), mesh.face(f))) all.push_back({e, f, *kind});
  return all;
}
template <class Q = oracle::Rational>
std::vector<Found> brute_intersections(const Mesh& mesh, const Eigen::MatrixXd& x) {
  return brute_intersections<Q>(mesh, x, [](int, int) { return true; });
}

inline std::vector<Found> plain(const std::vector<Intersection>& list) {
  std::vector<Found> all;
  for (const Intersection& p : list) all.push_back({p.edge, p.face, p.kind});
  return all;
}

}  // namespace onset::tests
