#include "tests/mpi/generated.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/scenes/meshes.hpp"

namespace onset::tests {
namespace {

using scenes::Random;
using scenes::Scene;

WholeScene whole(std::string name, const Scene& scene, const CollisionRules& rules = {}) {
  WholeScene r;
  r.name = std::move(name);
  r.mesh = Mesh(scene.x_t0, scene.faces, rules);
  r.x_t0 = scene.x_t0, r.x_t1 = scene.x_t1;
  return r;
}

Scene soup(Random& random, double size = 0.2, double speed = 0.2, int faces = 60) {
  return scenes::triangle_soup(faces, size, speed, random);
}

std::vector<int> bodies_of(const Scene& scene, int bodies) {
  std::vector<int> body = Mesh(scene.x_t0, scene.faces).components();
  for (int& b : body) b %= bodies;
  return body;
}

WholeScene folding_cloth(Random& random) {
  Scene cloth = scenes::cloth(9, 7);
  scenes::Scene above = scenes::translated(scenes::cloth(7, 9), Eigen::RowVector3d(0.1, -0.2, 0.05));
  scenes::displace(above, Eigen::RowVector3d(0.05, 0.1, -0.2));
  scenes::Scene both = scenes::joined(cloth, above);
  scenes::shake(both, 0.02, random);
  return whole("cloth", both);
}

WholeScene with_thickness(Random& random) {
  const Scene scene = soup(random, 0.15, 0.1);
  CollisionRules rules;
  for (Eigen::Index v = 0; v < scene.x_t0.rows(); ++v)
    rules.thickness.push_back(v % 5 == 0 ? 0.02 * scenes::unit(random) : 0.0);
  return whole("thickness", scene, rules);
}

WholeScene with_bodies(Random& random) {
  const Scene scene = soup(random, 0.25, 0.3, 70);
  CollisionRules rules;
  rules.bodies = bodies_of(scene, 6);
  rules.rigid_bodies = {true, false, false, false, true, false};
  rules.bodies_without_self_collision = {false, true, false, false, false, false};
  rules.excluded_bodies = {{0, 3}, {2, 5}};
  rules.body_separations = {{1, 2, 0.02}, {4, 0, 0.01}};
  return whole("bodies", scene, rules);
}

WholeScene with_static(Random& random) {
  Scene scene =
      scenes::joined(scenes::cube(), scenes::translated(scenes::sphere(6, 8), Eigen::RowVector3d(0, 0, 2.1)));
  CollisionRules rules;
  rules.static_vertices.assign(std::size_t(scene.x_t0.rows()), false);
  std::fill_n(rules.static_vertices.begin(), 8, true);
  for (Eigen::Index v = 8; v < scene.x_t1.rows(); ++v)
    for (int a = 0; a < 3; ++a) scene.x_t1(v, a) += 0.05 * scenes::unit(random) - (a == 2 ? 0.4 : 0);
  return whole("static", scene, rules);
}

WholeScene with_groups(Random& random) {
  const Scene scene = soup(random, 0.25, 0.3, 70);
  CollisionRules rules;
  for (Eigen::Index v = 0; v < scene.x_t0.rows(); ++v) {
    rules.groups.push_back(1u << (v / 3 % 3));
    rules.masks.push_back(v / 3 % 3 == 0 ? 6u : 5u);
  }
  return whole("groups", scene, rules);
}

// Two halves of a cloth with a seam of copied vertices.
WholeScene with_weld(Random& random) {
  const Scene left = scenes::cloth(6, 5);
  Scene scene = scenes::joined(left, scenes::translated(left, Eigen::RowVector3d(1, 0, 0)));
  for (Eigen::Index v = 0; v < scene.x_t1.rows(); ++v) {
    scene.x_t1(v, 2) += 0.3 * std::sin(3 * scene.x_t0(v, 0));
    scene.x_t1(v, 0) -= 0.2 * scene.x_t0(v, 0) * scene.x_t0(v, 0);
  }
  CollisionRules rules;
  rules.weld = true;
  rules.excluded_vertices = {{0, 1}, {3, int(scene.x_t0.rows()) - 2}};
  (void)random;
  return whole("weld", scene, rules);
}

WholeScene with_planes(Random& random) {
  const Scene scene = soup(random, 0.3, 0.4, 40);
  CollisionRules rules;
  rules.planes = {{{0, 0, 2}, -1.8}, {{1, 1, 0}, -1.9}};
  rules.thickness.assign(std::size_t(scene.x_t0.rows()), 0.001);
  return whole("planes", scene, rules);
}

WholeScene with_wires(Random& random) {
  const Scene scene = soup(random, 0.3, 0.3, 30);
  const int n = int(scene.x_t0.rows());
  WholeScene r;
  r.name = "wires and points";
  r.x_t0.resize(n + 40, 3), r.x_t1.resize(n + 40, 3);
  r.x_t0.topRows(n) = scene.x_t0, r.x_t1.topRows(n) = scene.x_t1;
  for (Eigen::Index v = n; v < n + 40; ++v)
    for (int a = 0; a < 3; ++a) {
      r.x_t0(v, a) = 2 * scenes::unit(random) - 1;
      r.x_t1(v, a) = r.x_t0(v, a) + 0.6 * scenes::unit(random) - 0.3;
    }
  Eigen::MatrixXi wires(10, 2);
  for (int i = 0; i < 10; ++i) wires.row(i) << n + 2 * i, n + 2 * i + 1;
  CollisionRules rules;
  for (int i = 39; i >= 20; --i) rules.points.push_back(n + i);
  r.mesh = Mesh(r.x_t0, complete_edges(wires, scene.faces), scene.faces, rules);
  r.edges_are_given = true;
  r.options.min_separation = 0.03;
  return r;
}

WholeScene in_plane(Random& random) {
  WholeScene r;
  r.name = "in the plane";
  const int n = 60;
  r.x_t0.resize(n, 2), r.x_t1.resize(n, 2);
  Eigen::MatrixXi E(40, 2);
  for (int i = 0; i < 20; ++i) {
    const double x = 4 * scenes::unit(random), y = 4 * scenes::unit(random);
    for (int k = 0; k < 3; ++k) {
      r.x_t0.row(3 * i + k) << x + 0.3 * scenes::unit(random), y + 0.3 * scenes::unit(random);
      r.x_t1.row(3 * i + k) =
          r.x_t0.row(3 * i + k) + Eigen::RowVector2d(0.5 * scenes::unit(random), -0.5 * scenes::unit(random));
    }
    E.row(2 * i) << 3 * i, 3 * i + 1, E.row(2 * i + 1) << 3 * i + 1, 3 * i + 2;
  }
  r.mesh = Mesh(r.x_t0, E);
  r.edges_are_given = true;
  return r;
}

// Cubes on a grid: widths of all axes tie, and starts touch.
WholeScene stacked_cubes(Random& random) {
  Scene scene = scenes::cube();
  for (int i = 1; i < 8; ++i)
    scene = scenes::joined(
        scene, scenes::translated(scenes::cube(), Eigen::RowVector3d(2.0 * (i & 1) + (i & 1) * 0.5,
                                                                     2.5 * (i >> 1 & 1), 2.5 * (i >> 2))));
  for (Eigen::Index v = 0; v < scene.x_t0.rows(); ++v)
    for (int a = 0; a < 3; ++a)
      scene.x_t1(v, a) = scene.x_t0(v, a) + std::round(4 * scenes::unit(random) - 2) / 4;
  return whole("cubes", scene);
}

WholeScene with_excluded_pairs(Random& random) {
  WholeScene r = whole("excluded pairs", soup(random, 0.4, 0.4, 40));
  const onset::ActiveSet set = construct_active_set(r.mesh, r.x_t0, r.x_t1);
  CollisionRules rules;
  for (std::size_t i = 0; i < set.size(); i += 3) rules.excluded_pairs.push_back(set[i]);
  const Intersections at = intersections(r.mesh, r.x_t0);
  for (std::size_t i = 0; i < at.pairs.size(); i += 2) rules.excluded_intersections.push_back(at.pairs[i]);
  r.mesh.set_rules(rules);
  return r;
}

WholeScene scaled(Random& random, double scale, double offset) {
  Scene scene = scenes::sphere_onto_sphere(6, 8, 0.01, 0.3);
  scenes::shake(scene, 0.01, random);
  scene.x_t0 = (scene.x_t0 * scale).array() + offset, scene.x_t1 = (scene.x_t1 * scale).array() + offset;
  WholeScene r = whole("scaled", scene);
  r.d_hat = 0.05 * scale;
  return r;
}

// All axes are equally wide, so that their order follows from single vertices.
WholeScene tied_widths(Random& random) {
  Scene scene = soup(random, 0.3, 0.3);
  scene.x_t0 *= 0.5, scene.x_t1 *= 0.5;
  Scene corners;
  corners.x_t0.resize(3, 3);
  corners.x_t0 << -1, -1, -1, 1, 1, 1, 1, -1, 1;
  corners.x_t1 = corners.x_t0;
  corners.faces.resize(1, 3);
  corners.faces << 0, 1, 2;
  return whole("equally wide", scenes::joined(scene, corners));
}

WholeScene with_rings(Random& random) {
  CollisionRules rules;
  rules.excluded_rings = 1 + int(3 * scenes::unit(random));
  Scene cloth = scenes::cloth(9, 8);
  for (Eigen::Index v = 0; v < cloth.x_t1.rows(); ++v) cloth.x_t1(v, 0) -= 1.4 * cloth.x_t0(v, 0);
  scenes::shake(cloth, 0.2, random);
  return whole("rings", cloth, rules);
}

// The last triangles and the lone rigid body fly far, and meet nobody.
WholeScene with_idle_primitives(Random& random) {
  Scene scene = soup(random, 0.25, 0.3, 40);
  const Eigen::Index flying = 9;
  const Eigen::Index n = scene.x_t0.rows();
  scene.x_t1.bottomRows(flying).array() += 1e7;
  CollisionRules rules;
  rules.groups.assign(std::size_t(n), 1u), rules.masks.assign(std::size_t(n), 1u);
  for (Eigen::Index v = n - flying; v < n; ++v)
    rules.groups[std::size_t(v)] = rules.masks[std::size_t(v)] = 0;
  WholeScene r = whole("idle primitives", scene, rules);
  r.options.narrow_phase = NarrowPhaseMethod::inclusion;
  return r;
}

WholeScene of_kind(int kind, int round, Random& random) {
  switch (kind) {
    case 0:
      return whole("soup", soup(random));
    case 1:
      return whole("fast soup", soup(random, 0.1, 1.5, 80));
    case 2:
      return folding_cloth(random);
    case 3:
      return whole("sphere onto cube", scenes::sphere_onto_cube(6, 8, 0.1, 0.1 + 0.05 * round));
    case 4:
      return whole("sphere onto sphere", scenes::sphere_onto_sphere(7, 9, 0.05, 0.3));
    case 5:
      return with_thickness(random);
    case 6:
      return with_bodies(random);
    case 7:
      return with_static(random);
    case 8:
      return with_groups(random);
    case 9:
      return with_weld(random);
    case 10:
      return with_planes(random);
    case 11:
      return with_wires(random);
    case 12:
      return in_plane(random);
    case 13:
      return stacked_cubes(random);
    case 14:
      return with_excluded_pairs(random);
    case 15:
      return scaled(random, 1e-150, 0);
    case 16:
      return scaled(random, 1, 3e7);
    case 17:
      return tied_widths(random);
    case 18:
      return with_rings(random);
    case 19:
      return with_idle_primitives(random);
    case 20:
      return whole("one triangle", scenes::triangle_soup(1, 0.5, 0.5, random));
    default:
      return whole("grid soup", soup(random, 0.6, 0.1, 25));
  }
}

void vary(WholeScene& scene, int round, Random& random) {
  Options& o = scene.options;
  if (round == 0) return;
  o.exactness = Exactness(scenes::unit(random) * 3);
  if (round % 3 == 1) o.window = scenes::unit(random) < 0.5 ? 0 : 0.1 * scenes::unit(random);
  if (round % 4 == 2 && scene.name != "scaled") o.min_separation = 0.02 * scenes::unit(random);
  if (round % 5 == 3) o.norm = Norm::maximum;
  if (round % 7 == 4) o.touching_may_pass_through = true;
  if (round % 6 == 5) o.max_checks = 1 + int(scenes::unit(random) * 3000);
  if (round % 8 == 6) o.narrow_phase = NarrowPhaseMethod::inclusion;
}

}  // namespace

WholeScene generated(int number) {
  Random random(std::uint64_t(number) + 17);
  const int kind = number % kSmallScenes, round = number / kSmallScenes;
  WholeScene scene = of_kind(kind, round, random);
  vary(scene, round, random);
  scene.name += " " + std::to_string(number);
  return scene;
}

}  // namespace onset::tests
