// Every pair of a mesh as a query of its own.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <onset/onset.hpp>
#include <tuple>
#include <vector>

#include "tests/queries/query.hpp"

namespace onset::tests {

inline double thickest(const std::vector<double>& t, const std::array<int, 4>& v, int first, int last) {
  double r = 0;
  for (int i = first; i < last; ++i) r = std::max(r, t[std::size_t(v[std::size_t(i)])]);
  return r;
}

inline scenes::Query query_of(PairKind kind, const std::array<int, 4>& v, const Eigen::MatrixXd& x_t0,
                              const Eigen::MatrixXd& x_t1) {
  scenes::Query q;
  q.kind = kind;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t a = 0; a < 3; ++a)
      q.t0[i][a] = x_t0(v[i], Eigen::Index(a)), q.t1[i][a] = x_t1(v[i], Eigen::Index(a));
  return q;
}

struct Key {
  PairKind kind;
  int a, b;
  bool operator<(const Key& o) const { return std::tuple(kind, a, b) < std::tuple(o.kind, o.a, o.b); }
};

// The row of a pair in an active set, or its size.
inline std::size_t row_of(const ActiveSet& set, const Key& pair) {
  std::size_t first = 0, last = set.size();
  while (first < last) {
    const std::size_t middle = (first + last) / 2;
    if (Key{set[middle].kind, set[middle].a, set[middle].b} < pair)
      first = middle + 1;
    else
      last = middle;
  }
  const bool found = first < set.size() && !(pair < Key{set[first].kind, set[first].a, set[first].b});
  return found ? first : set.size();
}

// Every pair of the mesh without a common vertex: visit(kind, a, b, vertices).
template <class F>
void for_all_pairs(const Mesh& mesh, F&& visit) {
  const auto apart = [](const std::array<int, 4>& v, int first) {
    for (int i = 0; i < first; ++i)
      for (int j = first; j < 4; ++j)
        if (v[std::size_t(i)] == v[std::size_t(j)]) return false;
    return true;
  };
  for (int v = 0; v < mesh.num_vertices(); ++v)
    for (int f = 0; f < mesh.num_faces(); ++f) {
      const auto c = mesh.face(f);
      if (const std::array<int, 4> all{v, c[0], c[1], c[2]}; apart(all, 1))
        visit(PairKind::vertex_face, v, f, all);
    }
  for (int a = 0; a < mesh.num_edges(); ++a)
    for (int b = a + 1; b < mesh.num_edges(); ++b) {
      const auto e = mesh.edge(a), g = mesh.edge(b);
      if (const std::array<int, 4> all{e[0], e[1], g[0], g[1]}; apart(all, 2))
        visit(PairKind::edge_edge, a, b, all);
    }
}

}  // namespace onset::tests
