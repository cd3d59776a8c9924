#include "tests/planes/plane_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace onset::tests {
namespace {

using scenes::Random;

double random_size(Random& random, bool plain) {
  if (plain) return scenes::power_of_ten(random, -2, 2);
  switch (scenes::integer(random, 0, 4)) {
    case 0:
      return scenes::power_of_ten(random, -150, 150);
    case 1:
      return scenes::power_of_ten(random, -323, -300);  // subnormal
    case 2:
      return scenes::power_of_ten(random, 280, 306);
    default:
      return scenes::power_of_ten(random, -10, 10);
  }
}

std::array<double, 3> random_normal(Random& random, bool plain) {
  std::array<double, 3> n = scenes::point(random);
  const int kind = scenes::integer(random, 0, 4);
  if (kind == 0)
    for (std::size_t a = 0; a < 3; ++a) n[a] = a == std::size_t(random() % 3) ? n[a] : 0;
  if (kind == 1)
    for (double& x : n) x = scenes::integer(random, -3, 3);
  if (kind == 2 && !plain) n[random() % 3] *= scenes::power_of_ten(random, -250, -20);
  const double size = plain ? 1 : scenes::coin(random) ? 1 : scenes::power_of_ten(random, -306, 306);
  for (double& x : n) x *= size;
  if (n[0] == 0 && n[1] == 0 && n[2] == 0) n[2] = size;
  return n;
}

double largest(const std::array<double, 3>& n) {
  return std::max({std::fabs(n[0]), std::fabs(n[1]), std::fabs(n[2])});
}

// Moves x along the plane's main axis to a distance of about h; rounding leaves it some way off.
void place(const Plane& plane, double h, Eigen::RowVector3d& x, Random& random) {
  const double scale = largest(plane.normal);
  int a = 0;
  for (int b = 1; b < 3; ++b)
    if (std::fabs(plane.normal[std::size_t(b)]) > std::fabs(plane.normal[std::size_t(a)])) a = b;
  double n[3], rest = plane.offset / scale, squares = 0;
  for (int b = 0; b < 3; ++b) n[b] = plane.normal[std::size_t(b)] / scale, squares += n[b] * n[b];
  for (int b = 0; b < 3; ++b)
    if (b != a) rest -= n[b] * x[b];
  x[a] = (rest + h * std::sqrt(squares)) / n[a];
  for (int k = scenes::integer(random, -2, 2); k != 0; k += k < 0 ? 1 : -1)
    if (scenes::coin(random)) x[a] = std::nextafter(x[a], k < 0 ? -INFINITY : INFINITY);
}

// How far from the plane, of things of some size that must keep a separation.
double random_height(double size, double separation, Random& random) {
  switch (scenes::integer(random, 0, 7)) {
    case 0:
      return separation;
    case 1:
      return 0;
    case 2:
      return separation + size * scenes::power_of_ten(random, -18, -12);
    case 3:
      return separation * scenes::uniform(random, 0, 2);
    case 4:
      return -size * scenes::power_of_ten(random, -16, 0);
    default:
      return separation + size * scenes::power_of_ten(random, -8, 0.5);
  }
}

// x with components a little below 2^1020.
Eigen::RowVector3d farthest(Random& random) {
  Eigen::RowVector3d x;
  for (int a = 0; a < 3; ++a) x[a] = 0x1p1020 * (1 - scenes::integer(random, 0, 100000) * 0x1p-53);
  return x;
}

bool usable(const Eigen::RowVector3d& x) { return x.cwiseAbs().maxCoeff() <= 0x1p1020; }

}  // namespace

PlaneScene random_plane_scene(Random& random, bool plain) {
  constexpr int kVertices = 8;
  const double size = random_size(random, plain);
  PlaneScene s;
  s.options.threads = 1;
  s.options.exactness = Exactness(scenes::integer(random, 0, 2));
  s.options.norm = scenes::integer(random, 0, 3) == 0 ? Norm::maximum : Norm::euclidean;
  if (scenes::coin(random)) s.options.min_separation = size * scenes::power_of_ten(random, -9, 0);
  for (int p = scenes::integer(random, 1, 2); p > 0; --p) {
    Plane plane;
    plane.normal = random_normal(random, plain);
    plane.offset = scenes::coin(random) ? 0 : scenes::uniform(random, -1, 1) * size * largest(plane.normal);
    if (!std::isfinite(plane.offset)) plane.offset = 0;
    s.rules.planes.push_back(plane);
  }
  s.x_t0.resize(kVertices, 3), s.x_t1.resize(kVertices, 3);
  const bool sound = scenes::coin(random);  // all start in front of the planes
  for (int v = 0; v < kVertices;) {
    const Plane& plane = s.rules.planes[random() % s.rules.planes.size()];
    Eigen::RowVector3d x0, x1;
    for (int a = 0; a < 3; ++a) x0[a] = scenes::uniform(random, -size, size);
    x1 = x0;
    if (scenes::coin(random))
      for (int a = 0; a < 3; ++a) x1[a] = scenes::uniform(random, -size, size);
    const double d = s.options.min_separation;
    place(plane, sound ? d + size * scenes::power_of_ten(random, -14, 0) : random_height(size, d, random), x0,
          random);
    if (scenes::integer(random, 0, 5) != 0)
      place(plane, random_height(size, d, random), x1, random);
    else if (scenes::coin(random))
      x1 = x0;
    if (!usable(x0) || !usable(x1)) continue;
    s.x_t0.row(v) = x0, s.x_t1.row(v) = x1;
    ++v;
  }
  return s;
}

PlaneScene plane_scene_at_the_largest_numbers(Random& random) {
  constexpr double kMost = std::numeric_limits<double>::max();
  PlaneScene s;
  s.options.threads = 1;
  s.options.norm = scenes::coin(random) ? Norm::maximum : Norm::euclidean;
  s.options.min_separation = 0x1p1020 * (scenes::coin(random) ? 1 : scenes::unit(random));
  Plane plane;
  for (double& n : plane.normal)
    n = scenes::coin(random) ? std::nextafter(2.0, 0.0) : 1 + scenes::unit(random);
  const Eigen::RowVector3d x = farthest(random);
  const double f = plane.normal[0] * x[0] + plane.normal[1] * x[1] + plane.normal[2] * x[2];
  plane.offset = -(kMost - f + scenes::integer(random, -1, 1) * 0x1p971);
  s.rules.planes.push_back(plane);
  s.x_t0.resize(4, 3), s.x_t1.resize(4, 3);
  for (int v = 0; v < 4; ++v) {
    s.x_t0.row(v) = v == 0 ? x : scenes::uniform(random, 0, 1) * x;
    s.x_t1.row(v) = (scenes::integer(random, 0, 3) == 0 ? scenes::uniform(random, -1, 1) : -1.0) * x;
  }
  return s;
}

}  // namespace onset::tests
