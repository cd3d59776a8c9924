#include "tests/src/support/crowds.hpp"

#include "tests/scenes/meshes.hpp"

namespace onset::tests {

using scenes::Random;

namespace {

Crowd of_scene(const char* name, const scenes::Scene& scene) {
  return {name, Mesh(scene.x_t0, scene.faces), scene.x_t0};
}

// Two sheets in the plane z = 0, the second moved within it by a multiple of half a cell, or by anything.
Crowd flat_sheets(Random& random, bool on_grid) {
  scenes::Scene sheets = scenes::cloth(4, 5);
  Eigen::RowVector3d offset(scenes::integer(random, 0, 8) / 8.0, scenes::integer(random, 0, 6) / 6.0, 0);
  if (!on_grid) offset = Eigen::RowVector3d(scenes::unit(random), scenes::unit(random), 0);
  sheets = scenes::joined(sheets, scenes::translated(scenes::cloth(3, 4), offset));
  return of_scene("sheets in a plane", sheets);
}

// A strip folded along its cells onto itself: vertices of different places of it coincide.
Crowd folded_strip(Random& random) {
  scenes::Scene strip = scenes::cloth(2, 9);
  for (Eigen::Index v = 0; v < strip.x_t0.rows(); ++v) {
    const double s = 8 * strip.x_t0(v, 0);
    strip.x_t0(v, 0) = s > 4 ? 8 - s : s;
  }
  strip.x_t0.array() += scenes::integer(random, -2, 2);
  return of_scene("folded strip", strip);
}

}  // namespace

Crowd grid_crowd(int count, int size, Random& random) {
  const int wires = count / 2, points = count / 2, vertices = 3 * count + 2 * wires + points;
  Eigen::MatrixXd x(vertices, 3);
  for (Eigen::Index i = 0; i < x.size(); ++i) x.data()[i] = scenes::integer(random, -size, size);
  Eigen::MatrixXi faces(count, 3), edges(wires, 2);
  for (int f = 0; f < count; ++f)  // some share a vertex with the one before
    faces.row(f) << (f > 0 && scenes::coin(random) ? 3 * f - 1 : 3 * f), 3 * f + 1, 3 * f + 2;
  for (int e = 0; e < wires; ++e) edges.row(e) << 3 * count + 2 * e, 3 * count + 2 * e + 1;
  CollisionRules rules;
  for (int v = vertices - points; v < vertices; ++v) rules.points.push_back(v);
  return {"grid", Mesh(vertices, complete_edges(edges, faces), faces, rules), std::move(x)};
}

Crowd some_crowd(int round, Random& random) {
  switch (round % 6) {
    case 0:
      return of_scene("soup", scenes::triangle_soup(40, 0.5, 0, random));
    case 1:
      return flat_sheets(random, true);
    case 2:
      return flat_sheets(random, false);
    case 3:
      return folded_strip(random);
    case 4:
      return round % 4 == 0 ? apart_crowd() : of_scene("sphere", scenes::sphere(5, 8));
    default:
      return grid_crowd(20, scenes::integer(random, 1, 4), random);
  }
}

Crowd apart_crowd() {
  return of_scene(
      "apart", scenes::joined(scenes::cloth(4, 4), scenes::translated(scenes::cloth(5, 4), {0.1, 0.1, 0.1})));
}

}  // namespace onset::tests
