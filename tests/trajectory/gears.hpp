// Two gears on axles: what turns by more than a little, in the narrowest of places.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <onset/trajectory.hpp>
#include <vector>

#include "tests/scenes/meshes.hpp"

namespace onset::tests {

struct GearShape {
  int teeth = 12;
  double bore = 0.4, root = 0.82, tip = 1.06, thickness = 0.25;
  // Half the width of a tooth, as a share of the pitch, at root and tip.
  double half_root = 0.21, half_tip = 0.09;
};

// A ring of quadrilaterals between circles i and j of `n` vertices each.
inline void add_band(std::vector<Eigen::RowVector3i>& faces, int i, int j, int n) {
  for (int k = 0; k < n; ++k) {
    const int l = (k + 1) % n;
    faces.push_back({i * n + k, i * n + l, j * n + l});
    faces.push_back({i * n + k, j * n + l, j * n + k});
  }
}

inline scenes::Scene made_of(const std::vector<Eigen::RowVector3d>& x,
                             const std::vector<Eigen::RowVector3i>& f) {
  scenes::Scene s;
  s.x_t0.resize(Eigen::Index(x.size()), 3), s.faces.resize(Eigen::Index(f.size()), 3);
  for (std::size_t i = 0; i < x.size(); ++i) s.x_t0.row(Eigen::Index(i)) = x[i];
  for (std::size_t i = 0; i < f.size(); ++i) s.faces.row(Eigen::Index(i)) = f[i];
  s.x_t1 = s.x_t0;
  return s;
}

// About the z axis, with a bore; a tooth is at the angle `turned`.
inline scenes::Scene gear(const GearShape& g, double turned) {
  constexpr double kPi = 3.14159265358979323846;
  std::vector<Eigen::RowVector3d> x;
  std::vector<Eigen::RowVector3i> faces;
  const double share[4] = {-g.half_root, -g.half_tip, g.half_tip, g.half_root};
  for (const auto& [outer, z] :
       {std::pair(true, 0.0), {true, g.thickness}, {false, g.thickness}, {false, 0.0}})
    for (int t = 0; t < g.teeth; ++t)
      for (int k = 0; k < 4; ++k) {
        const double angle = turned + 2 * kPi * (t + share[k]) / g.teeth;
        const double r = !outer ? g.bore : k == 1 || k == 2 ? g.tip : g.root;
        x.push_back({r * std::cos(angle), r * std::sin(angle), z});
      }
  for (int ring = 0; ring < 4; ++ring) add_band(faces, ring, (ring + 1) % 4, 4 * g.teeth);
  return made_of(x, faces);
}

// A tube about the z axis that sticks out of the gear.
inline scenes::Scene axle(double radius, double thickness) {
  constexpr double kPi = 3.14159265358979323846;
  std::vector<Eigen::RowVector3d> x;
  std::vector<Eigen::RowVector3i> faces;
  for (const double z : {-0.2, thickness + 0.2})
    for (int k = 0; k < 24; ++k)
      x.push_back({radius * std::cos(2 * kPi * k / 24), radius * std::sin(2 * kPi * k / 24), z});
  add_band(faces, 0, 1, 24);
  return made_of(x, faces);
}

struct Gears {
  scenes::Scene scene;  // x_t1: where the ends of the true motion are
  RigidTrajectory trajectory;
  int gear_vertices;
};

// The first turns by `first` about (0, 0), the second by `second` about (2, 0), with a tooth of one between
// two of the other; both axles stand.
inline Gears gears(double first, double second) {
  constexpr double kPi = 3.14159265358979323846;
  const GearShape shape;
  const scenes::Scene a = gear(shape, 0);
  const scenes::Scene b = scenes::translated(gear(shape, kPi + kPi / shape.teeth), {2, 0, 0});
  const scenes::Scene axles =
      scenes::joined(axle(0.38, shape.thickness), scenes::translated(axle(0.38, shape.thickness), {2, 0, 0}));
  Gears r{scenes::joined(scenes::joined(a, b), axles), RigidTrajectory(Eigen::MatrixXd(0, 3)),
          int(a.x_t0.rows())};
  r.trajectory = RigidTrajectory(r.scene.x_t0);
  r.trajectory.add_body(0, r.gear_vertices, {0, 0, first}, {0, 0, 0}, {0, 0, 0});
  r.trajectory.add_body(r.gear_vertices, 2 * r.gear_vertices, {0, 0, second}, {0, 0, 0}, {2, 0, 0});
  r.scene.x_t1 = r.trajectory.at(1);
  return r;
}

}  // namespace onset::tests
