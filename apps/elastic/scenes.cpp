#include "elastic/scenes.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <stdexcept>

#include "elastic/meshes/gmsh.hpp"

namespace elastic {
namespace {

constexpr double kPi = 3.14159265358979323846;

class Builder {
 public:
  explicit Builder(unsigned seed) : random_(seed) {}

  double uniform(double low, double high) { return low + (high - low) * double(random_() >> 8) * 0x1p-24; }
  // Any, so that nothing is exactly parallel.
  Eigen::Quaterniond turn(double most) {
    const Vec3 axis(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    return Eigen::Quaterniond(Eigen::AngleAxisd(uniform(0.5, 1) * most, axis.normalized()));
  }

  void add(const TetMesh& mesh, const Eigen::Quaterniond& turned, const Vec3& centre,
           bool is_static = false) {
    const int first = int(positions_.size());
    for (const Vec3& p : mesh.points) {
      rest_.push_back(p);
      positions_.push_back(turned * p + centre);
      scene_.is_free.push_back(!is_static);
      scene_.is_static.push_back(is_static);
      scene_.bodies.push_back(bodies_);
    }
    for (Tetrahedron t : mesh.tetrahedra) {
      if (!is_static) measure(mesh, t);
      for (int& v : t) v += first;
      scene_.tetrahedra.push_back(t);
    }
    ++bodies_;
  }

  Scene& scene() { return scene_; }

  Scene finish() {
    const auto flat = [](const std::vector<Vec3>& points) {
      Vector x(3 * Eigen::Index(points.size()));
      for (std::size_t v = 0; v < points.size(); ++v) x.segment<3>(3 * Eigen::Index(v)) = points[v];
      return x;
    };
    scene_.x = flat(positions_);
    scene_.rest = flat(rest_);
    scene_.edge = lengths_ / edges_;
    return scene_;
  }

 private:
  void measure(const TetMesh& mesh, const Tetrahedron& t) {
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < i; ++j, ++edges_)
        lengths_ += (mesh.points[std::size_t(t[i])] - mesh.points[std::size_t(t[j])]).norm();
  }

  std::mt19937 random_;
  std::vector<Vec3> positions_, rest_;
  Scene scene_;
  int bodies_ = 0;
  double lengths_ = 0, edges_ = 0;
};

Scene torus_on_cone(const SceneOptions& o) {
  Builder b(o.seed);
  b.add(torus(0.3, 0.1, o.tetrahedra), b.turn(0.1), {0, 0, 0.5});
  b.add(cone(0.5, 0.5, 24), Eigen::Quaterniond::Identity(), Vec3::Zero(), true);
  return b.finish();
}

// About a common axis, a turn and a half a second, while the ends come closer.
Scene bars(const SceneOptions& o) {
  Builder b(o.seed);
  constexpr int kBars = 3;
  constexpr double kLength = 1, kWidth = 0.1;
  // kBars boxes of 6 cells^2 (10 cells) tetrahedra
  const int across = std::max(1, int(std::lround(std::cbrt(o.tetrahedra / (kBars * 60.0)))));
  const int along = std::max(2, int(std::lround(o.tetrahedra / (kBars * 6.0 * across * across))));
  const TetMesh bar = box({kLength, kWidth, kWidth}, {along, across, across});
  for (int i = 0; i < kBars; ++i) {
    const double angle = 2 * kPi * i / kBars + 0.1;
    const Eigen::Quaterniond turned(Eigen::AngleAxisd(angle, Vec3::UnitX()));
    b.add(bar, turned, turned * Vec3(0, 0, 1.1 * kWidth));
  }
  Scene& scene = b.scene();
  scene.gravity.setZero();
  Scene all = b.finish();
  for (std::size_t v = 0; v < all.vertices(); ++v)
    all.is_free[v] = std::fabs(all.rest[3 * Eigen::Index(v)]) < kLength / 2 - 1e-9;
  all.moved_to = [start = all.x](int v, double time) -> Vec3 {
    Vec3 p = at(start, v);
    const double side = p.x() > 0 ? 1 : -1;
    p.x() *= 1 - 0.1 * time;
    return Eigen::AngleAxisd(side * 1.5 * kPi * time, Vec3::UnitX()) * p;
  };
  return all;
}

Scene pile(const SceneOptions& o) {
  Builder b(o.seed);
  constexpr int kBodies = 8;
  const int each = o.tetrahedra / kBodies;
  const TetMesh kinds[] = {torus(0.09, 0.04, each), rounded_cube(0.09, each), ball(0.1, each)};
  for (int i = 0; i < kBodies; ++i) {
    const double side = 0.13;  // bodies of different layers cover each other in part
    const Vec3 centre(side * (i % 2 ? 1 : -1) + b.uniform(-0.02, 0.02),
                      side * (i / 2 % 2 ? 1 : -1) + b.uniform(-0.02, 0.02), 0.2 + 0.3 * (i / 4));
    b.add(kinds[(i + i / 4) % 3], b.turn(1.5), centre + Vec3(i / 4 * 0.1, 0, 0));
  }
  b.scene().planes.push_back({{0, 0, 1}, 0});
  for (const double side : {-1.0, 1.0}) {  // four slopes around, on which nothing rolls away
    b.scene().planes.push_back({{side * 0.8, 0, 0.6}, -0.18});
    b.scene().planes.push_back({{0, side * 0.8, 0.6}, -0.18});
  }
  return b.finish();
}

Scene drop(const SceneOptions& o) {
  if (o.mesh.empty()) throw std::invalid_argument("scene 'drop' needs --mesh FILE.msh");
  const TetMesh mesh = read_msh(o.mesh);
  Builder b(o.seed);
  const Eigen::Quaterniond turned = b.turn(0.1);
  Vec3 low = Vec3::Constant(INFINITY), high = -low;
  for (const Vec3& p : mesh.points) {
    low = low.cwiseMin(turned * p);
    high = high.cwiseMax(turned * p);
  }
  const Vec3 middle = (low + high) / 2;
  b.add(mesh, turned, {-middle.x(), -middle.y(), 0.1 * (high - low).maxCoeff() - low.z()});
  b.scene().planes.push_back({{0, 0, 1}, 0});
  return b.finish();
}

}  // namespace

Scene make_scene(const SceneOptions& options) {
  if (options.name == "torus") return torus_on_cone(options);
  if (options.name == "bars") return bars(options);
  if (options.name == "pile") return pile(options);
  if (options.name == "drop") return drop(options);
  throw std::invalid_argument("there is no scene '" + options.name + "': torus, bars, pile, drop");
}

}  // namespace elastic
