// The exact contacts of a small scene.
#pragma once

#include <functional>
#include <onset/onset.hpp>
#include <vector>

#include "tests/oracle/within.hpp"
#include "tests/src/support/mesh_pairs.hpp"

namespace onset::tests {

// A motion of vertices, edges (those of the faces among them) and faces.
struct StepScene {
  Eigen::MatrixXd x_t0, x_t1;
  Eigen::MatrixXi edges, faces;
  Mesh mesh() const { return Mesh(x_t0, edges, faces); }
  std::vector<int> points() const;  // the vertices of no edge
};

// What a call is asked, and of what.
struct Asked {
  const Mesh& mesh;
  const Eigen::MatrixXd &x_t0, &x_t1;
  Options options;
  std::vector<double> thickness;                                              // of the mesh; empty: none
  bool weld = false;                                                          // as the mesh was told
  std::function<bool(PairKind, int, int, const std::array<int, 4>&)> lets{};  // empty: all pairs meet
  // What each pair must keep; empty: Options::min_separation and thickness.
  std::function<double(PairKind, const std::array<int, 4>&)> keeps{};
  double separation(PairKind kind, const std::array<int, 4>& vertices) const;  // that this pair must keep
  bool is_welded(PairKind kind, const std::array<int, 4>& vertices) const;
  // Every pair that may meet: visit(kind, a, b, vertices).
  template <class F>
  void for_pairs(F&& visit) const {
    for_all_pairs(mesh, [&](PairKind kind, int a, int b, const std::array<int, 4>& v) {
      if ((!lets || lets(kind, a, b, v)) && (!weld || !is_welded(kind, v))) visit(kind, a, b, v);
    });
  }
};

struct PairTruth {
  Key key;
  std::array<int, 4> vertices;
  scenes::Query motion;
  double separation;
  oracle::Truth within;  // the first time within the separation
  bool touching;         // distance 0 at t = 0
  bool initial() const { return within.toi_hi == 0; }
};

// Pairs that come within their separation in [0, 1], in the order of the active set.
struct SceneTruth {
  std::vector<PairTruth> contacts;
  explicit SceneTruth(const Asked& asked);
  oracle::Truth first() const;
  oracle::Truth first_met()
      const;  // without pairs that start within their separation and do not touch: they may part
  const PairTruth* touching() const;  // the first pair that touches at the start
  bool initial() const { return first().toi_hi == 0; }
};

}  // namespace onset::tests
