#include "onset/commands/demo_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace app {
namespace {

using Vector = Eigen::Vector3d;
using Triangle = std::array<int, 3>;

constexpr double kPi = 3.14159265358979323846;
constexpr double kRadius = 0.5;                // of the sphere, centred at the origin
constexpr double kClearance = 0.05;            // between the sphere's top and the cloth
constexpr int kColumns = 70, kRows = 36;       // quads of the cloth, along and across
constexpr double kLength = 2.2, kWidth = 1.1;  // of the cloth when unfolded
constexpr double kFold = 0.03;                 // radius of the fold: the layers are twice that apart
constexpr double kFall = 0.12,
                 kUpperLayerFall = 0.08;  // of all of the cloth; of the upper layer on top of it

struct Body {
  std::vector<Vector> x_t0, x_t1;
  std::vector<Triangle> faces;
};

// Arc length s along the cloth: the lower layer towards -x, half a circle, the upper layer back.
Vector folded(double s, double y) {
  const double flat = (kLength - kPi * kFold) / 2, end = -flat / 2;
  const double base = kRadius + kClearance + kFold;
  if (s < flat) return {end + flat - s, y, base - kFold};
  const double angle = (s - flat) / kFold;
  if (angle < kPi) return {end - kFold * std::sin(angle), y, base - kFold * std::cos(angle)};
  return {end + s - flat - kPi * kFold, y, base + kFold};
}

// 0 in the lower layer, 1 in the upper, smooth in between.
double upper_layer(const Vector& p) {
  const double t = std::clamp((p.z() - kRadius - kClearance) / (2 * kFold), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

Body make_cloth() {
  Body cloth;
  for (int i = 0; i <= kColumns; ++i)
    for (int j = 0; j <= kRows; ++j) {
      const Vector flat = folded(kLength * i / kColumns, kWidth * (double(j) / kRows - 0.5));
      const double upper = upper_layer(flat);
      const double ripple = 0.01 * std::sin(9 * flat.x() + 2 * upper) * std::cos(7 * flat.y());
      const Vector start = flat + Vector(0, 0, ripple);
      cloth.x_t0.push_back(start);
      cloth.x_t1.push_back(start - Vector(0, 0, kFall + upper * kUpperLayerFall));
    }
  const auto id = [](int i, int j) { return i * (kRows + 1) + j; };
  for (int i = 0; i < kColumns; ++i)
    for (int j = 0; j < kRows; ++j) {
      cloth.faces.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      cloth.faces.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  return cloth;
}

// Each triangle into four; points midway are pushed out to the unit sphere and shared along edges.
void refine(Body& sphere) {
  std::map<std::pair<int, int>, int> midpoints;
  const auto midpoint = [&](int a, int b) {
    const auto [found, added] = midpoints.try_emplace(std::minmax(a, b), int(sphere.x_t0.size()));
    if (added) sphere.x_t0.push_back((sphere.x_t0[a] + sphere.x_t0[b]).normalized());
    return found->second;
  };
  std::vector<Triangle> finer;
  for (const auto& [a, b, c] : sphere.faces) {
    const int ab = midpoint(a, b), bc = midpoint(b, c), ca = midpoint(c, a);
    finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
  }
  sphere.faces = std::move(finer);
}

Body make_sphere() {
  const double g = (1 + std::sqrt(5.0)) / 2;
  Body sphere;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-g, g})
      for (const Vector& p : {Vector(0, a, b), Vector(a, b, 0), Vector(b, 0, a)})
        sphere.x_t0.push_back(p.normalized());
  for (int a = 0; a < 12; ++a)  // an icosahedron's faces: the triples of points that are neighbours
    for (int b = a + 1; b < 12; ++b)
      for (int c = b + 1; c < 12; ++c) {
        const auto near = [&](int i, int j) { return sphere.x_t0[i].dot(sphere.x_t0[j]) > 0.4; };
        if (near(a, b) && near(b, c) && near(c, a)) sphere.faces.push_back({a, b, c});
      }
  for (int level = 0; level < 3; ++level) refine(sphere);
  for (Vector& p : sphere.x_t0) p *= kRadius;
  sphere.x_t1 = sphere.x_t0;
  return sphere;
}

}  // namespace

DemoScene make_demo_scene() {
  const Body cloth = make_cloth(), sphere = make_sphere();
  const auto vertices = Eigen::Index(cloth.x_t0.size() + sphere.x_t0.size());
  DemoScene scene{Points(vertices, 3),
                  Points(vertices, 3),
                  {},
                  std::ptrdiff_t(cloth.faces.size()),
                  std::ptrdiff_t(sphere.faces.size())};
  scene.faces.resize(scene.cloth_faces + scene.sphere_faces, 3);
  Eigen::Index v = 0, f = 0;
  for (const Body* body : {&cloth, &sphere}) {
    const Eigen::Index first = v;
    for (std::size_t i = 0; i < body->x_t0.size(); ++i, ++v) {
      scene.x_t0.row(v) = body->x_t0[i];
      scene.x_t1.row(v) = body->x_t1[i];
    }
    for (const auto& [a, b, c] : body->faces) scene.faces.row(f++) << first + a, first + b, first + c;
  }
  return scene;
}

}  // namespace app
