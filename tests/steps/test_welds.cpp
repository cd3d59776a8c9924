// CollisionRules::weld: the copies of a seam's vertices count as one while they stay together, and as others
// when not.
#include <map>
#include <onset/onset.hpp>

#include "tests/catch.hpp"
#include "tests/oracle/promises.hpp"
#include "tests/scenes/meshes.hpp"

using namespace onset;
using scenes::Random;
using scenes::Scene;

namespace {

// The scene with the first half of its faces and the others sharing no vertex: a seam of copies between them.
Scene cut(const Scene& scene) {
  std::map<std::pair<bool, int>, int> id;
  std::vector<int> of;  // vertices of the scene
  Scene s;
  s.faces = scene.faces;
  for (Eigen::Index f = 0; f < s.faces.rows(); ++f)
    for (int k = 0; k < 3; ++k) {
      const auto [place, added] = id.insert({{2 * f < s.faces.rows(), scene.faces(f, k)}, int(of.size())});
      if (added) of.push_back(scene.faces(f, k));
      s.faces(f, k) = place->second;
    }
  s.x_t0.resize(Eigen::Index(of.size()), 3), s.x_t1.resize(Eigen::Index(of.size()), 3);
  for (std::size_t v = 0; v < of.size(); ++v)
    s.x_t0.row(Eigen::Index(v)) = scene.x_t0.row(of[v]), s.x_t1.row(Eigen::Index(v)) = scene.x_t1.row(of[v]);
  return s;
}

Mesh welded(const Scene& scene) {
  CollisionRules rules;
  rules.weld = true;
  return Mesh(scene.x_t0, scene.faces, rules);
}

// Cloth that folds onto itself, or falls onto a cube.
Scene folding(Random& random) {
  Scene cloth = scenes::cloth(5, 4);
  for (Eigen::Index v = 0; v < cloth.x_t0.rows(); ++v) {
    const double x = cloth.x_t0(v, 0);
    cloth.x_t1(v, 0) = x < 0.5 ? x : 1 - x;
    cloth.x_t1(v, 2) = x < 0.5 ? 0 : 2 * (x - 0.5) * scenes::uniform(random, -0.1, 0.3);
  }
  scenes::shake(cloth, 0.05, random);
  return cloth;
}

Options exactly() {
  Options options;
  options.exactness = Exactness::exact;
  options.tolerance = 1e-8;
  return options;
}

}  // namespace

TEST_CASE("a welded seam has the contacts of the mesh that was never cut", "[property]") {
  Random random(oracle::fuzz_seed() + 51);
  int contacts = 0, free = 0;
  for (int i = 0; i < oracle::fuzz(40); ++i) {
    const Scene whole = folding(random), parts = cut(whole);
    const Mesh mesh = welded(parts);
    const StepResult expected =
        compute_collision_free_stepsize(Mesh(whole.x_t0, whole.faces), whole.x_t0, whole.x_t1, exactly());
    const StepResult r = compute_collision_free_stepsize(mesh, parts.x_t0, parts.x_t1, exactly());
    CAPTURE(i, expected.step, expected.toi, to_string(expected.outcome));
    CHECK(r.outcome == expected.outcome);
    CHECK((r.toi == expected.toi && r.toi_hi == expected.toi_hi));
    CHECK(std::abs(r.step - expected.step) < 1e-5);
    CHECK(is_step_collision_free(mesh, parts.x_t0, parts.x_t1, exactly()) ==
          (expected.outcome == Outcome::free));
    ++(expected.outcome == Outcome::free ? free : contacts);

    const Mesh open(parts.x_t0, parts.faces);
    CHECK(compute_collision_free_stepsize(open, parts.x_t0, parts.x_t1, exactly()).step == 0);
  }
  CHECK((contacts > oracle::fuzz(40) / 4 && free > 0));
}

TEST_CASE("a welded seam that moves, turns and stretches as one blocks no call", "[unit]") {
  Scene cloth = scenes::cloth(4, 4);
  cloth.x_t1.col(2) = 0.5 * cloth.x_t1.col(0);
  cloth.x_t1.col(1) *= 1.5;
  const Scene parts = cut(cloth);
  const Mesh mesh = welded(parts), open(parts.x_t0, parts.faces);
  const Eigen::MatrixXd &x = parts.x_t0, &to = parts.x_t1;
  const Options o = exactly();
  CHECK(compute_collision_free_stepsize(mesh, x, to, o).outcome == Outcome::free);
  CHECK(construct_active_set(mesh, x, to, o).size() == 0);
  CHECK(is_step_collision_free(mesh, x, to, o));
  CHECK(LineSearch(mesh, x, Eigen::MatrixXd(to - x), o).largest_step().step == 1);
  const Candidates list = compute_candidates(mesh, x, to, o);
  CHECK(compute_collision_free_stepsize(mesh, list, x, to, o, 0.2).step == 1);
  const ClosePairs close = close_pairs(mesh, x, 0.01, o);
  CHECK(close.size() == 0);
  CHECK(compute_cfl_stepsize(mesh, x, to, close, o).step > 0);
  CHECK(close_pairs(open, x, 0.01, o).size() > 0);
  CHECK(compute_candidates(open, x, to, o).counts.total() > list.counts.total());
}

TEST_CASE("copies that are together at one end of the motion only are not welded", "[unit]") {
  const Scene parts = cut(scenes::cloth(4, 4));
  const Mesh mesh = welded(parts);
  Eigen::MatrixXd pulled = parts.x_t0;  // the half of the last face, by as little as there is
  pulled.bottomRows(pulled.rows() / 2).col(2).array() += 0x1p-1074;
  const StepResult apart = compute_collision_free_stepsize(mesh, parts.x_t0, pulled);
  CHECK((apart.step == 0 && apart.outcome == Outcome::initial_contact && apart.toi == 0));
  CHECK_FALSE(is_step_collision_free(mesh, parts.x_t0, pulled));
  const StepResult together = compute_collision_free_stepsize(mesh, pulled, parts.x_t0);
  CHECK((together.step < 1 && together.toi <= 1));
  CHECK_FALSE(is_step_collision_free(mesh, pulled, parts.x_t0));
}

TEST_CASE("a weld is taken back, and copies of a mesh have their own", "[unit]") {
  const Scene parts = cut(scenes::cloth(3, 3));
  Mesh mesh(parts.x_t0, parts.faces);
  const auto step = [&](const Mesh& m) {
    return compute_collision_free_stepsize(m, parts.x_t0, parts.x_t1).step;
  };
  CHECK(step(mesh) == 0);
  CollisionRules rules;
  rules.weld = true;
  mesh.set_rules(rules);
  const Mesh copy = mesh;
  CHECK(step(mesh) == 1);
  rules.weld = false;
  mesh.set_rules(rules);
  CHECK((step(mesh) == 0 && step(copy) == 1));
}
