#include "tests/src/support/scene_set.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace onset::tests {

using scenes::Random;
using scenes::Scene;

static Scene crumpling_cloth(Random& random) {
  Scene upper = scenes::translated(scenes::cloth(12, 12), {0.03, 0.02, 0.05});
  scenes::displace(upper, {0, 0, -0.08});
  scenes::shake(upper, 0.06, random);
  return joined(upper, scenes::cloth(10, 11));
}

// Two cubes, the upper one falls onto the lower: every contact is a tie of vertices, edges and faces.
static Scene cube_onto_cube() {
  Scene upper = scenes::translated(scenes::cube(), {0, 0, 2.5});
  scenes::displace(upper, {0, 0, -1});
  return joined(upper, scenes::cube());
}

std::vector<NamedScene> some_scenes() {
  Random random(5);
  return {{"sparse soup", scenes::triangle_soup(150, 0.15, 0.1, random)},
          {"dense soup", scenes::triangle_soup(60, 0.5, 0.6, random)},
          {"resting soup", scenes::triangle_soup(100, 0.3, 0, random)},
          {"sphere onto cube", scenes::sphere_onto_cube(7, 12, 0.25, 0.75)},
          {"sphere short of cube", scenes::sphere_onto_cube(7, 12, 0.25, 0.125)},
          {"sphere onto sphere", scenes::sphere_onto_sphere(8, 11, 0.01, 0.1)},
          {"crumpling cloth", crumpling_cloth(random)},
          {"cube onto cube", cube_onto_cube()},
          {"fast soup", scenes::triangle_soup(150, 0.05, 0.6, random)}};
}

Scene on_grid(Scene scene) {
  for (Eigen::MatrixXd* x : {&scene.x_t0, &scene.x_t1})
    *x = x->unaryExpr([](double v) { return std::ldexp(std::round(std::ldexp(v, 20)), -20); });
  return scene;
}

template <class Doubles>
static bool same_array(const Doubles& a, const Doubles& b) {
  return a.size() == b.size() &&
         (a.size() == 0 || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}
static bool same_pair(const Pair& a, const Pair& b) {
  return a.kind == b.kind && a.a == b.a && a.b == b.b && a.vertices == b.vertices;
}

bool same_but_certainty(const Contact& a, const Contact& b) {
  const auto numbers = [](const Contact& c) {
    return std::array<double, 5>{c.toi, c.step_limit, c.tolerance, c.gap, c.speed};
  };
  return same_pair(a, b) && same_array(numbers(a), numbers(b)) && a.outcome == b.outcome &&
         a.degenerate == b.degenerate && same_array(a.weights, b.weights) && same_array(a.normal, b.normal);
}

bool same_bytes(const Contact& a, const Contact& b) {
  return same_but_certainty(a, b) && a.certainty == b.certainty &&
         std::memcmp(&a.toi_hi, &b.toi_hi, sizeof(double)) == 0;
}

bool same_bytes(const ActiveSet& a, const ActiveSet& b) {
  return a.outcome == b.outcome && a.vertex == b.vertex &&
         std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Contact& c, const Contact& d) { return same_bytes(c, d); });
}

bool same_bytes(const StepResult& a, const StepResult& b) {
  const auto numbers = [](const StepResult& r) {
    return std::vector<double>{r.step, r.shortest, r.toi, r.toi_hi, r.rounding};
  };
  return same_array(numbers(a), numbers(b)) && a.outcome == b.outcome && a.certainty == b.certainty &&
         a.vertex == b.vertex && a.limiting.has_value() == b.limiting.has_value() &&
         (!a.limiting || same_pair(*a.limiting, *b.limiting));
}

}  // namespace onset::tests
