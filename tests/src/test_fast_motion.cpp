// Steps of many times a triangle's size: the active set holds the pairs that touch, each found on its own.
#include <cmath>

#include "broadphase/box_test.hpp"
#include "scene/motion/motion.hpp"
#include "tests/catch.hpp"
#include "tests/fuzz.hpp"
#include "tests/src/support/mesh_pairs.hpp"
#include "tests/src/support/scene_set.hpp"

using namespace onset;
using namespace onset::tests;

namespace {

// Coordinates in eighths: boxes and primitives touch, and part, at the same time on several axes.
scenes::Scene in_eighths(scenes::Scene scene) {
  for (Eigen::MatrixXd* x : {&scene.x_t0, &scene.x_t1})
    *x = x->unaryExpr([](double v) { return std::round(8 * v) / 8; });
  return scene;
}

// Returns the number of contacts.
int expect_all_that_touch(const scenes::Scene& scene) {
  const Mesh mesh(scene.x_t0, scene.faces);
  Options o;
  o.exactness = Exactness::exact;
  const ActiveSet set = construct_active_set(mesh, scene.x_t0, scene.x_t1, o);
  int contacts = 0;
  for_all_pairs(mesh, [&](PairKind kind, int a, int b, const std::array<int, 4>& v) {
    const QueryResult alone = ccd(query_of(kind, v, scene.x_t0, scene.x_t1), o);
    const bool touches = alone.outcome != PairOutcome::free, found = row_of(set, {kind, a, b}) < set.size();
    contacts += touches;
    if (touches != found)
      FAIL_CHECK((touches ? "missed: " : "too much: ") << int(kind) << " " << a << " " << b);
  });
  return contacts;
}

}  // namespace

TEST_CASE("the active set of fast triangles holds exactly the pairs that touch", "[property][oracle]") {
  scenes::Random random(97);
  int contacts = 0, in_line = 0, passing = 0;
  for (int round = 0; round < fuzz(12); ++round) {
    const double size = scenes::uniform(random, 0.05, 0.3), speed = size * scenes::uniform(random, 3, 12);
    const scenes::Scene scene = scenes::triangle_soup(40, size, speed, random);
    CAPTURE(round, size, speed);
    contacts += expect_all_that_touch(scene);
    contacts += expect_all_that_touch(scenes::translated(scene, {100.1, -33.3, 1000.7}));
    in_line += expect_all_that_touch(in_eighths(scene));
    const Mesh mesh(scene.x_t0, scene.faces);
    passing +=
        cheaper_box_test(mesh.data(), make_motion(mesh.data(), scene.x_t0, scene.x_t1)) == BoxTest::moving;
  }
  CHECK(contacts > 20 * fuzz(12));
  CHECK(in_line > 20 * fuzz(12));
  CHECK(2 * passing > fuzz(12));
}
