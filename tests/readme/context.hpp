// What the fragments of C++ in the documents take for granted, by the names that they use.
#pragma once

#include <Eigen/SparseCore>
#include <cmath>
#include <cstdio>
#include <onset/compat/ipc.hpp>
#include <onset/onset.hpp>
#include <vector>

// Four triangles of which the second touches the third, and a vertex of its own.
struct Context {
  Eigen::MatrixXd x{13, 3}, x_t0, x_t1;
  Eigen::MatrixXi F{4, 3};
  onset::Mesh mesh;
  onset::Options options;
  onset::StartReport report;
  std::vector<bool> is_obstacle = std::vector<bool>(13), is_rigid = std::vector<bool>(5);
  std::vector<std::uint32_t> groups = std::vector<std::uint32_t>(13, 1),
                             masks = std::vector<std::uint32_t>(13, 1);
  std::vector<int> loose{12}, full_ids;
  Eigen::MatrixXd x_rest;
  int full_vertices = 20;

  Context() {
    for (int i = 0; i < 4; ++i) {
      x.middleRows(3 * i, 3) << 0, 0, i, 1, 0, i, 0, 1, i;
      F.row(i) << 3 * i, 3 * i + 1, 3 * i + 2;
    }
    x.row(3) << 0.25, 0.25, 2;
    x.row(12) << 9, 9, 9;
    x_t0 = x_t1 = x_rest = x;
    mesh = onset::Mesh(x, F);
    report = onset::check(mesh, x);
    is_obstacle[0] = is_obstacle[1] = is_obstacle[2] = true;
    is_rigid[3] = true;
    for (int v = 0; v < 13; ++v) full_ids.push_back(v + 5);
  }
};
