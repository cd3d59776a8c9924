#include "tests/scenes/meshes.hpp"

#include <cmath>

namespace onset::scenes {

static Scene at_rest(const Eigen::MatrixXd& x, const Eigen::MatrixXi& faces) { return {x, x, faces}; }

static Eigen::RowVector3d row(const Point& p) { return {p[0], p[1], p[2]}; }

Scene triangle_soup(int faces, double size, double speed, Random& random) {
  Eigen::MatrixXd x(3 * faces, 3);
  Eigen::MatrixXi F(faces, 3);
  for (int f = 0; f < faces; ++f) {
    const Eigen::RowVector3d centre = row(point(random));
    for (int k = 0; k < 3; ++k) x.row(3 * f + k) = centre + row(point(random, size));
    F.row(f) << 3 * f, 3 * f + 1, 3 * f + 2;
  }
  Scene scene = at_rest(x, F);
  shake(scene, speed, random);
  return scene;
}

Scene cloth(int rows, int cols) {
  Eigen::MatrixXd x(rows * cols, 3);
  Eigen::MatrixXi F(2 * (rows - 1) * (cols - 1), 3);
  for (int r = 0, f = 0; r < rows; ++r)
    for (int c = 0; c < cols; ++c) {
      x.row(r * cols + c) << double(c) / (cols - 1), double(r) / (rows - 1), 0;
      if (r + 1 == rows || c + 1 == cols) continue;
      const int a = r * cols + c, b = a + 1, d = a + cols, e = d + 1;
      if ((r + c) % 2)
        F.row(f) << a, b, e, F.row(f + 1) << a, e, d;
      else
        F.row(f) << a, b, d, F.row(f + 1) << b, e, d;
      f += 2;
    }
  return at_rest(x, F);
}

Scene sphere(int rings, int segments) {
  const double pi = std::acos(-1.0);
  const int south = rings * segments, north = south + 1;
  Eigen::MatrixXd x(north + 1, 3);
  Eigen::MatrixXi F(2 * rings * segments, 3);
  int f = 0;
  for (int r = 0; r < rings; ++r)
    for (int s = 0; s < segments; ++s) {
      const double latitude = pi * (r + 1) / (rings + 1), longitude = 2 * pi * s / segments;
      x.row(r * segments + s) << std::sin(latitude) * std::cos(longitude),
          std::sin(latitude) * std::sin(longitude), -std::cos(latitude);
      const int a = r * segments + s, b = r * segments + (s + 1) % segments;
      if (r == 0) F.row(f++) << south, b, a;
      if (r + 1 == rings)
        F.row(f++) << a, b, north;
      else
        F.row(f++) << a, b, a + segments, F.row(f++) << b, b + segments, a + segments;
    }
  x.row(south) << 0, 0, -1;
  x.row(north) << 0, 0, 1;
  return at_rest(x, F);
}

Scene cube() {
  Eigen::MatrixXd x(8, 3);
  for (int i = 0; i < 8; ++i) x.row(i) << (i & 1 ? 1 : -1), (i & 2 ? 1 : -1), (i & 4 ? 1 : -1);
  Eigen::MatrixXi F(12, 3);
  F << 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3,
      7, 5;
  return at_rest(x, F);
}

Scene joined(const Scene& a, const Scene& b) {
  const auto stacked = [](const auto& top, const auto& bottom) {
    std::decay_t<decltype(top)> m(top.rows() + bottom.rows(), 3);
    m << top, bottom;
    return m;
  };
  return {stacked(a.x_t0, b.x_t0), stacked(a.x_t1, b.x_t1),
          stacked(a.faces, Eigen::MatrixXi(b.faces.array() + int(a.x_t0.rows())))};
}

Scene translated(Scene scene, const Eigen::RowVector3d& offset) {
  scene.x_t0.rowwise() += offset;
  scene.x_t1.rowwise() += offset;
  return scene;
}

void displace(Scene& scene, const Eigen::RowVector3d& step) { scene.x_t1.rowwise() += step; }

void shake(Scene& scene, double size, Random& random) {
  for (Eigen::Index i = 0; i < scene.x_t1.rows(); ++i) scene.x_t1.row(i) += row(point(random, size));
}

Scene sphere_onto_cube(int rings, int segments, double gap, double step) {
  Scene ball = translated(sphere(rings, segments), {0.125, 0.25, 2 + gap});
  displace(ball, {0, 0, -step});
  return joined(ball, cube());
}

Scene sphere_onto_sphere(int rings, int segments, double gap, double step) {
  Scene ball = translated(sphere(rings, segments), {2 + gap, 0, 0});
  displace(ball, {-step, 0, 0});
  Scene other = sphere(rings, segments);
  const double c = std::cos(0.37), s = std::sin(0.37);
  Eigen::Matrix3d turn;
  turn << c, -s, 0, s * s, s * c, -c, s * c, c * c, s;
  other.x_t0 = other.x_t1 = other.x_t0 * turn.transpose();
  return joined(ball, other);
}

}  // namespace onset::scenes
