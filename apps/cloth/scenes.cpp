#include "cloth/scenes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <stdexcept>

namespace cloth {
namespace {

constexpr double kPi = 3.14159265358979323846;

class Builder {
 public:
  explicit Builder(unsigned seed) : random_(seed) {}

  double uniform(double low, double high) { return low + (high - low) * double(random_() >> 8) * 0x1p-24; }

  // A sheet of width x length at height z, `triangles` in all, turned by `yaw` about its centre and rippled,
  // so that nothing is exactly parallel.
  void add_sheet(double width, double length, int triangles, double z, double yaw) {
    edge_ = std::sqrt(2 * width * length / triangles);
    const int rows = std::max(2, int(std::lround(width / edge_))),
              columns = std::max(2, triangles / (2 * rows));
    const int first = int(positions_.size());
    const Eigen::AngleAxisd turn(yaw, Vec3::UnitZ());
    for (int i = 0; i <= rows; ++i)
      for (int j = 0; j <= columns; ++j) {
        const Vec3 flat(length * (double(j) / columns - 0.5), width * (double(i) / rows - 0.5), z);
        rest_.push_back(flat);
        positions_.push_back(turn * (flat + Vec3(0, 0, uniform(-0.02, 0.02) * edge_)));
      }
    for (int i = 0; i < rows; ++i)
      for (int j = 0; j < columns; ++j) {
        const int a = first + i * (columns + 1) + j, b = a + 1, c = a + columns + 1, d = c + 1;
        const bool flip = (i + j) % 2;
        faces_.push_back({a, b, flip ? c : d});
        faces_.push_back({flip ? b : a, d, c});
      }
  }

  void end_cloth(Scene& scene) {
    scene.cloth_faces = faces_.size();
    scene.edge = edge_;
    scene.is_free.assign(positions_.size(), 1);
  }

  // An icosahedron, each of its faces cut into four `levels` times, on the sphere.
  void add_sphere(const Vec3& centre, double radius, int levels) {
    const double g = (1 + std::sqrt(5.0)) / 2;
    std::vector<Vec3> p;
    for (const double a : {-1.0, 1.0})
      for (const double b : {-g, g})
        for (const Vec3& corner : {Vec3(0, a, b), Vec3(a, b, 0), Vec3(b, 0, a)})
          p.push_back(corner.normalized());
    std::vector<std::array<int, 3>> faces;
    const auto near = [&](int i, int j) { return p[std::size_t(i)].dot(p[std::size_t(j)]) > 0.4; };
    for (int a = 0; a < 12; ++a)
      for (int b = a + 1; b < 12; ++b)
        for (int c = b + 1; c < 12; ++c)
          if (near(a, b) && near(b, c) && near(c, a)) faces.push_back({a, b, c});
    for (int level = 0; level < levels; ++level) refine(p, faces);
    const int first = int(positions_.size());
    for (const Vec3& q : p) add_point(centre + radius * q);
    for (const auto& [a, b, c] : faces) faces_.push_back({first + a, first + b, first + c});
  }

  void add_floor(double size, double z) {
    const int first = int(positions_.size());
    for (const double y : {-size, size})
      for (const double x : {-size, size}) add_point({x, y, z});
    faces_.push_back({first, first + 1, first + 3});
    faces_.push_back({first, first + 3, first + 2});
  }

  void finish(Scene& scene) {
    const auto flat = [](const std::vector<Vec3>& points) {
      Vector x(3 * Eigen::Index(points.size()));
      for (std::size_t v = 0; v < points.size(); ++v) x.segment<3>(3 * Eigen::Index(v)) = points[v];
      return x;
    };
    scene.x = flat(positions_);
    scene.rest = flat(rest_);
    scene.faces = faces_;
    scene.is_free.resize(positions_.size(), 0);
  }

 private:
  static void refine(std::vector<Vec3>& p, std::vector<std::array<int, 3>>& faces) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [found, added] = middles.try_emplace(std::minmax(a, b), int(p.size()));
      if (added) p.push_back((p[std::size_t(a)] + p[std::size_t(b)]).normalized());
      return found->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : faces) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    faces = std::move(finer);
  }
  void add_point(const Vec3& p) { positions_.push_back(p), rest_.push_back(p); }

  std::mt19937 random_;
  std::vector<Vec3> positions_, rest_;
  std::vector<std::array<int, 3>> faces_;
  double edge_ = 0;
};

Scene sphere(int triangles, unsigned seed) {
  Scene scene;
  Builder b(seed);
  b.add_sheet(1, 1, triangles, 0.27, 0);
  b.end_cloth(scene);
  b.add_sphere(Vec3::Zero(), 0.25, 2);
  b.finish(scene);
  const auto first = std::find(scene.is_free.begin(), scene.is_free.end(), 0);
  scene.turning = Turning{int(first - scene.is_free.begin()), 2 * Vec3::UnitZ(), Vec3::Zero()};
  return scene;
}

Scene twist(int triangles, unsigned seed) {
  Scene scene;
  Builder b(seed);
  b.add_sheet(0.4, 1, triangles, 0, 0);
  b.end_cloth(scene);
  b.finish(scene);
  scene.gravity.setZero();
  for (std::size_t v = 0; v < scene.is_free.size(); ++v)
    scene.is_free[v] = std::fabs(scene.rest[3 * Eigen::Index(v)]) < 0.5 - 1e-9;
  scene.moved_to = [start = scene.x](int v, double time) -> Vec3 {
    Vec3 p = at(start, v);
    const double side = p.x() > 0 ? 1 : -1;
    p.x() *= 1 - 0.3 * time;
    return Eigen::AngleAxisd(side * 1.7 * kPi * time, Vec3::UnitX()) * p;
  };
  return scene;
}

// On a floor of two triangles, or on a plane.
Scene pile(int triangles, unsigned seed, bool on_plane) {
  Scene scene;
  Builder b(seed);
  constexpr int kSheets = 5;
  for (int i = 0; i < kSheets; ++i)
    b.add_sheet(0.5, 0.5, triangles / kSheets, 0.13 + 0.03 * i, b.uniform(0, kPi / 2));
  b.end_cloth(scene);
  b.add_sphere(Vec3::Zero(), 0.1, 2);
  if (on_plane)
    scene.planes.push_back({{0, 0, 1}, -0.11});
  else
    b.add_floor(1, -0.11);
  b.finish(scene);
  scene.moved_to = [start = scene.x](int v, double) -> Vec3 { return at(start, v); };
  return scene;
}

}  // namespace

Scene make_scene(const std::string& name, int triangles, unsigned seed) {
  if (name == "sphere") return sphere(triangles, seed);
  if (name == "twist") return twist(triangles, seed);
  if (name == "pile") return pile(triangles, seed, false);
  if (name == "ground") return pile(triangles, seed, true);
  throw std::invalid_argument("there is no scene '" + name + "': sphere, twist, pile, ground");
}

}  // namespace cloth
