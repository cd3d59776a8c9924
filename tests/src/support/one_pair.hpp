// A pair of primitives as a scene of its own.
#pragma once

#include <Eigen/Core>
#include <onset/onset.hpp>

#include "tests/queries/query.hpp"

namespace onset::tests {

struct Elements {
  Eigen::MatrixXi edges, faces;
};
// A vertex and a face, whose edges meet nothing, or two wires: rows 0 to 3 are the query's points.
inline Elements elements_of(PairKind kind) {
  Elements e{Eigen::MatrixXi(2, 2), Eigen::MatrixXi(0, 3)};
  if (kind == PairKind::edge_edge) {
    e.edges << 0, 1, 2, 3;
    return e;
  }
  e.faces.resize(1, 3);
  e.faces << 1, 2, 3;
  e.edges = onset::edges(e.faces);
  return e;
}
inline Mesh mesh_of(PairKind kind) {
  const Elements e = elements_of(kind);
  return Mesh(4, e.edges, e.faces);
}

inline Eigen::MatrixXd positions(const std::array<Point, 4>& points) {
  Eigen::MatrixXd x(4, 3);
  for (int i = 0; i < 4; ++i) x.row(i) << points[i][0], points[i][1], points[i][2];
  return x;
}

}  // namespace onset::tests
