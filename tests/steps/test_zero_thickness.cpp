// A thickness of zero changes nothing: not where all vertices have it, nor for a pair whose own have it.
#include "tests/catch.hpp"
#include "tests/oracle/promises.hpp"
#include "tests/src/support/scene_set.hpp"
#include "tests/steps/support/promises.hpp"
#include "tests/steps/support/random_scenes.hpp"

using namespace onset;
using namespace onset::tests;
using scenes::Random;

namespace {

// The scene, and a triangle above another far away, which are to be thick.
StepScene with_company(const StepScene& scene, double where) {
  StepScene s;
  const Eigen::Index n = scene.x_t0.rows();
  for (const auto& [from, to] : {std::pair(&scene.x_t0, &s.x_t0), std::pair(&scene.x_t1, &s.x_t1)}) {
    to->resize(n + 6, 3);
    to->topRows(n) = *from;
    to->bottomRows(6) << where, 0, 0, where + 1, 0, 0, where, 1, 0, where, 0, 1, where + 1, 0, 1, where, 1, 1;
  }
  s.faces.resize(scene.faces.rows() + 2, 3);
  s.faces.topRows(scene.faces.rows()) = scene.faces;
  s.faces.bottomRows(2) << n, n + 1, n + 2, n + 3, n + 4, n + 5;
  s.edges.resize(scene.edges.rows() + 6, 2);
  s.edges.topRows(scene.edges.rows()) = scene.edges;
  s.edges.bottomRows(6) << n, n + 1, n, n + 2, n + 1, n + 2, n + 3, n + 4, n + 3, n + 5, n + 4, n + 5;
  return s;
}

}  // namespace

TEST_CASE("zero thickness gives the same bytes as none", "[property][determinism]") {
  Random random(oracle::fuzz_seed() * 1000 + 81);
  for (int i = 0; i < oracle::fuzz(300); ++i) {
    const StepScene s = random_scene(random);
    const Options o = random_options(s, random);
    const Mesh plain = s.mesh();
    Mesh thin = plain;
    CollisionRules rules;
    rules.thickness.assign(std::size_t(plain.num_vertices()), 0);
    thin.set_rules(rules);
    CAPTURE(i, int(o.exactness), o.min_separation, int(o.norm));
    CHECK(same_bytes(compute_collision_free_stepsize(plain, s.x_t0, s.x_t1, o),
                     compute_collision_free_stepsize(thin, s.x_t0, s.x_t1, o)));
    CHECK(same_bytes(construct_active_set(plain, s.x_t0, s.x_t1, o),
                     construct_active_set(thin, s.x_t0, s.x_t1, o)));
    CHECK(is_step_collision_free(plain, s.x_t0, s.x_t1, o) ==
          is_step_collision_free(thin, s.x_t0, s.x_t1, o));
    const Eigen::MatrixXd dx = s.x_t1 - s.x_t0;
    CHECK(same_bytes(LineSearch(plain, s.x_t0, dx, o).largest_step(),
                     LineSearch(thin, s.x_t0, dx, o).largest_step()));
  }
}

TEST_CASE("a pair without thickness is decided exactly though others have some", "[property][oracle]") {
  Random random(oracle::fuzz_seed() * 1000 + 82);
  int contacts = 0;
  for (int i = 0; i < oracle::fuzz(100); ++i) {
    const StepScene bare = scenes::coin(random) ? grid_scene(random) : floor_scene(random);
    const double size = std::max(bare.x_t0.cwiseAbs().maxCoeff(), bare.x_t1.cwiseAbs().maxCoeff());
    const StepScene s = with_company(bare, 4 * size + 4);
    Mesh mesh = s.mesh();
    std::vector<double> thickness(std::size_t(mesh.num_vertices()), 0);
    std::fill(thickness.end() - 6, thickness.end(), 0.125);
    CollisionRules rules;
    rules.thickness = thickness;
    mesh.set_rules(rules);
    Options o = random_options(bare, random);
    o.min_separation = 0, o.exactness = Exactness::exact;
    const Asked asked{mesh, s.x_t0, s.x_t1, o, thickness};
    const SceneTruth truth(asked);
    const ActiveSet set = construct_active_set(mesh, s.x_t0, s.x_t1, o);
    const StepResult r = compute_collision_free_stepsize(mesh, s.x_t0, s.x_t1, o);
    CAPTURE(i, o.relative_tolerance, o.tolerance.value_or(0), o.max_checks, int(o.narrow_phase));
    CHECK(set.size() == truth.contacts.size());
    CHECK(wrong_set(asked, truth, set) == "");
    CHECK(r.toi == truth.first().toi_lo);
    CHECK(r.toi_hi == truth.first().toi_hi);
    for (const Contact& c : set) CHECK(c.certainty != Certainty::within_tolerance);
    contacts += int(set.size());
  }
  CHECK(contacts > oracle::fuzz(100));
}
