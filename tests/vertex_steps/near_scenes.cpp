#include "tests/vertex_steps/near_scenes.hpp"

#include <Eigen/Geometry>

namespace onset::tests {
namespace {

using scenes::coin;
using scenes::integer;
using scenes::power_of_ten;
using scenes::Random;
using scenes::uniform;

Eigen::RowVector3d any_vector(Random& random, double size) {
  Eigen::RowVector3d v;
  for (int a = 0; a < 3; ++a) v[a] = uniform(random, -size, size);
  return v;
}

Eigen::Matrix3d any_rotation(Random& random) {
  if (integer(random, 0, 3) == 0) return Eigen::Matrix3d::Identity();
  const Eigen::RowVector3d axis = any_vector(random, 1);
  return Eigen::AngleAxisd(uniform(random, 0, 6), axis.normalized().transpose()).toRotationMatrix();
}

// Layers of a triangle or a wire each, `gap` apart along z, some of them tilted away.
void put_layers(StepScene& scene, int parts, double gap, Random& random) {
  for (int part = 0; part < parts; ++part)
    for (int i = 0; i < 3; ++i) {
      Eigen::RowVector3d x = any_vector(random, 1);
      x[2] = part * gap + (coin(random) ? 0 : uniform(random, 0, 0.5) * gap);
      scene.x_t0.row(3 * part + i) = x;
    }
}

// Each part as a whole, each vertex on its own, or only some.
void put_motion(StepScene& scene, int parts, double speed, Random& random) {
  scene.x_t1 = scene.x_t0;
  const int way = integer(random, 0, 3);
  for (int part = 0; part < parts; ++part) {
    Eigen::RowVector3d step = any_vector(random, speed);
    if (way == 0) step = {0, 0, part % 2 == 0 ? speed : -speed};
    for (int i = 0; i < 3; ++i) {
      if (way == 2) step = any_vector(random, speed);
      if (way == 3 && coin(random)) continue;
      scene.x_t1.row(3 * part + i) += step;
    }
  }
}

}  // namespace

NearScene near_scene(Random& random) {
  NearScene near;
  StepScene& scene = near.scene;
  const int parts = integer(random, 2, 4), wires = integer(random, 0, parts);
  scene.x_t0.resize(3 * parts, 3);
  const bool touching = integer(random, 0, 9) == 0;
  const double gap = touching ? 0 : power_of_ten(random, -14, -1), size = power_of_ten(random, -9, 9);
  const bool layers = integer(random, 0, 4) > 0;
  if (layers) {
    put_layers(scene, parts, gap, random);
  } else {
    for (Eigen::Index v = 0; v < scene.x_t0.rows(); ++v) scene.x_t0.row(v) = any_vector(random, 1);
  }
  put_motion(scene, parts, power_of_ten(random, -4, 1), random);
  Eigen::Matrix3d turn = size * Eigen::Matrix3d::Identity();  // a turn would part some that touch
  if (!touching) turn *= any_rotation(random);
  const Eigen::RowVector3d place = any_vector(random, integer(random, 0, 3) == 0 ? 10 * size : 0);
  for (Eigen::MatrixXd* x : {&scene.x_t0, &scene.x_t1}) *x = (*x * turn).eval().rowwise() + place;
  scene.faces.resize(parts - wires, 3);
  for (int f = wires; f < parts; ++f) scene.faces.row(f - wires) << 3 * f, 3 * f + 1, 3 * f + 2;
  Eigen::MatrixXi lines(2 * wires, 2);
  for (int w = 0; w < wires; ++w)
    lines.row(2 * w) << 3 * w, 3 * w + 1, lines.row(2 * w + 1) << 3 * w + 1, 3 * w + 2;
  scene.edges = complete_edges(lines, scene.faces);
  TruncateOptions& o = near.options;
  constexpr double kShares[] = {0, 0.1, 0.5};
  o.gap_share = kShares[integer(random, 0, 2)];
  if (integer(random, 0, 3) == 0) o.min_separation = gap * size * power_of_ten(random, -2, 0.5);
  if (coin(random)) o.norm = Norm::maximum;
  if (integer(random, 0, 2) == 0) o.d_hat = size * power_of_ten(random, -3, 1);
  return near;
}

}  // namespace onset::tests
