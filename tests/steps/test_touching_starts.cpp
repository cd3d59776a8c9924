// Starts at a gap of exactly 0: whatever the motion, the pair blocks it and is named, by every call.
#include "tests/catch.hpp"
#include "tests/oracle/promises.hpp"
#include "tests/queries/random_query.hpp"
#include "tests/scenes/families.hpp"
#include "tests/scenes/meshes.hpp"
#include "tests/src/support/one_pair.hpp"
#include "tests/steps/support/promises.hpp"

using namespace onset;
using namespace onset::tests;
using scenes::Query;
using scenes::Random;
using scenes::Scene;

namespace {

StepScene step_scene(const Scene& scene) {
  return {scene.x_t0, scene.x_t1, onset::edges(scene.faces), scene.faces};
}

Scene triangle(const Eigen::RowVector3d& a, const Eigen::RowVector3d& b, const Eigen::RowVector3d& c) {
  Scene s{Eigen::MatrixXd(3, 3), {}, Eigen::MatrixXi(1, 3)};
  s.x_t0 << a, b, c;
  s.x_t1 = s.x_t0;
  s.faces << 0, 1, 2;
  return s;
}

struct Touching {
  const char* name;
  Scene first, second;
  Eigen::RowVector3d parts{0, 0, 1};  // the first body's way out of the contact; 0: there is none
};

std::vector<Touching> touching_bodies() {
  const Scene plate = triangle({-2, -2, 0}, {2, -2, 0}, {0, 2, 0});
  const Scene sheet = scenes::cloth(3, 3);
  return {{"a tip on a face", triangle({0, 0, 0}, {1, 0, 1}, {0, 1, 1}), plate},
          {"a tip on an edge", triangle({0, -2, 0}, {1, -3, 1}, {-1, -3, 1}), plate},
          {"a tip on a tip", triangle({0, 2, 0}, {1, 3, 1}, {-1, 3, 1}), plate},
          {"a side on a face", triangle({-0.5, 0, 0}, {0.5, 0, 0}, {0, 0, 1}), plate},
          {"a side across a side", triangle({0, -3, 0}, {0, -2.5, 1}, {0, -1.5, -1}), plate, {0, -1, 0}},
          {"a side on a side", triangle({-1, -2, 0}, {1, -2, 0}, {0, -3, 1}), plate},
          {"a face in a face", triangle({-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0, 0.5, 0}), plate},
          {"sheets in one plane", scenes::translated(sheet, {0.25, 0.125, 0}), sheet},
          {"sheets side by side", scenes::translated(sheet, {1, 0, 0}), sheet, {1, 0, 0}},
          {"a cube on a cube", scenes::translated(scenes::cube(), {0.5, 0.25, 2}), scenes::cube()},
          {"a cube by a cube", scenes::translated(scenes::cube(), {2, 0, 0}), scenes::cube(), {1, 0, 0}}};
}

// To part, to press, to slide, to stay, both as one, and each vertex by itself.
std::vector<Scene> motions(const Touching& bodies, Random& random) {
  std::vector<Scene> all;
  for (const Eigen::RowVector3d& step :
       {Eigen::RowVector3d(0, 0, 1), Eigen::RowVector3d(0, 0, -1), Eigen::RowVector3d(0.5, 0.25, 0),
        Eigen::RowVector3d(0, 0, 0), Eigen::RowVector3d(1, -2, 0x1p-40), Eigen::RowVector3d(3, 3, 3)}) {
    Scene first = bodies.first;
    scenes::displace(first, step);
    all.push_back(scenes::joined(first, bodies.second));
  }
  Scene as_one = scenes::joined(bodies.first, bodies.second), at_random = as_one;
  scenes::displace(as_one, {1, 2, 3});
  scenes::shake(at_random, 1, random);
  all.push_back(as_one), all.push_back(at_random);
  return all;
}

std::vector<Options> ways_to_ask() {
  std::vector<Options> all(7);
  all[1].exactness = Exactness::exact;
  all[2].exactness = Exactness::conservative, all[2].relative_tolerance = 1e-300;
  all[3].min_separation = 0.01, all[3].max_checks = 1;
  all[4].min_separation = 0.125, all[4].norm = Norm::maximum;
  all[5].narrow_phase = NarrowPhaseMethod::inclusion, all[5].max_checks = 50;
  all[6].window = 0;
  return all;
}

void check_blocked(const Scene& scene, const Options& options) {
  const StepScene s = step_scene(scene);
  const Calls calls(s);
  const Asked asked{calls.mesh(), s.x_t0, s.x_t1, options, {}};
  const SceneTruth truth(asked);
  const PairTruth* first = truth.touching();
  REQUIRE(first);
  CHECK(broken_promise(asked, calls, 0.3) == "");
  for (Call call : kCalls) {
    if (Calls::is_adapter(call) && options.norm != Norm::euclidean) continue;
    CAPTURE(name(call));
    CHECK(calls.ask(call, s.x_t0, s.x_t1, options, 0.3).result.step == 0);
  }
  const ActiveSet set = construct_active_set(asked.mesh, s.x_t0, s.x_t1, options);
  const std::size_t row = row_of(set, first->key);
  REQUIRE(row < set.size());
  CHECK((set[row].toi == 0 && set[row].step_limit == 0));
  if (options.min_separation == 0) CHECK(set[row].certainty == Certainty::touching_at_start);
  CHECK_FALSE(is_step_collision_free(asked.mesh, s.x_t0, s.x_t1, options));
}

}  // namespace

TEST_CASE("bodies that touch at the start block the step, whatever they do next", "[unit][oracle]") {
  Random random(oracle::fuzz_seed() + 41);
  for (const Touching& bodies : touching_bodies()) {
    const std::vector<Options> ways = ways_to_ask();
    std::size_t way = 0;
    for (const Scene& scene : motions(bodies, random)) {
      const Options& options = ways[way++ % ways.size()];
      CAPTURE(bodies.name, way, options.min_separation, int(options.norm));
      check_blocked(scene, options);
    }
  }
}

TEST_CASE("a pair that touches exactly at the start blocks the step and is a contact at 0",
          "[property][oracle]") {
  for (const scenes::Family& family : scenes::touching_families())
    for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
      const std::string which = family.name;
      if (which != "touching_t0" && which != "touching_inside_t0") continue;
      Random random = scenes::seeded(family, kind, oracle::fuzz_seed() + 42);
      for (int i = 0; i < oracle::fuzz(40); ++i) {
        Query query = family.make(kind, random);
        if (scenes::integer(random, 0, 4) == 0) query.t1 = query.t0;
        Options options;
        options.exactness = Exactness(scenes::integer(random, 0, 2));
        options.relative_tolerance = scenes::power_of_ten(random, -300, -1);
        INFO(family.name << " " << to_text(query));
        const QueryResult r = scenes::ccd(query, options);
        CHECK(r.outcome == PairOutcome::initial_contact);
        CHECK((r.toi == 0 && r.step_limit == 0));
        CHECK(r.certainty == Certainty::touching_at_start);
        const Elements e = elements_of(kind);
        const StepScene scene{positions(query.t0), positions(query.t1), e.edges, e.faces};
        const Calls calls(scene);
        CHECK(broken_promise({calls.mesh(), scene.x_t0, scene.x_t1, options, {}}, calls, 1) == "");
      }
    }
}

TEST_CASE("what touches and is left out by a rule does not block", "[unit][oracle]") {
  for (const Touching& bodies : touching_bodies()) {
    Scene scene = scenes::joined(bodies.first, bodies.second);
    scenes::displace(scene, {0, 0, 1});
    for (int rule = 0; rule < 3; ++rule) {
      Mesh mesh(scene.x_t0, scene.faces);
      std::vector<int> body(std::size_t(mesh.num_vertices()), 1);
      std::fill_n(body.begin(), bodies.first.x_t0.rows(), 0);
      CollisionRules rules;
      rules.bodies = body;
      const std::vector<std::uint32_t> groups(body.begin(), body.end());
      if (rule == 0) rules.excluded_bodies = {{0, 1}};
      if (rule == 1) rules.groups = groups, rules.masks.assign(groups.size(), 0);
      if (rule == 2)
        for (int i = 0; i < int(body.size()); ++i)
          for (int j = 0; j < i; ++j)
            if (body[std::size_t(i)] != body[std::size_t(j)]) rules.excluded_vertices.push_back({j, i});
      mesh.set_rules(rules);
      CAPTURE(bodies.name, rule);
      const StepResult r = compute_collision_free_stepsize(mesh, scene.x_t0, scene.x_t1);
      CHECK((r.step == 1 && r.outcome == Outcome::free && r.toi == INFINITY));
      CHECK(construct_active_set(mesh, scene.x_t0, scene.x_t1).size() == 0);
      CHECK(is_step_collision_free(mesh, scene.x_t0, scene.x_t1));
    }
  }
}

// From the right side, as a resting contact of a solver that keeps no gap.
TEST_CASE("a touching pair may leave its contact where the caller says so", "[unit][oracle]") {
  Options options;
  options.touching_may_pass_through = true;
  for (const Touching& bodies : touching_bodies()) {
    if (bodies.parts == Eigen::RowVector3d(0, 0, 0)) continue;
    Scene first = bodies.first;
    scenes::displace(first, bodies.parts);
    const Scene scene = scenes::joined(first, bodies.second);
    CAPTURE(bodies.name);
    const Mesh mesh(scene.x_t0, scene.faces);
    const StepResult r = compute_collision_free_stepsize(mesh, scene.x_t0, scene.x_t1, options);
    CHECK(r.step == 1);
    CHECK(r.outcome != Outcome::initial_contact);
    CHECK(compute_collision_free_stepsize(mesh, scene.x_t0, scene.x_t1).step == 0);
  }
}

TEST_CASE("a pair that may leave its contact is stopped by the next one", "[unit][oracle]") {
  // The vertex leaves the first face, and flies into a second one parallel to it at height 1.
  Eigen::MatrixXd x_t0(7, 3);
  x_t0 << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1, .25, .25, 0;
  Eigen::MatrixXi F(2, 3);
  F << 0, 1, 2, 3, 4, 5;
  Eigen::MatrixXd x_t1 = x_t0;
  x_t1(6, 2) = 2;
  Options options;
  const Mesh mesh(x_t0, F);
  CHECK(compute_collision_free_stepsize(mesh, x_t0, x_t1, options).step == 0);
  options.touching_may_pass_through = true;
  const StepResult r = compute_collision_free_stepsize(mesh, x_t0, x_t1, options);
  CHECK(r.outcome == Outcome::contact);
  CHECK(r.step < 0.5);
  CHECK(r.step > 0.499);
  REQUIRE(r.limiting);
  CHECK(r.limiting->b == 1);
}
