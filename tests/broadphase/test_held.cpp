// A tree that holds pairs from call to call finds what brute force finds, whatever came before.
#include <cmath>
#include <onset/active_set.hpp>
#include <onset/mesh.hpp>
#include <onset/step_size.hpp>
#include <string>

#include "broadphase/held/held_candidates.hpp"
#include "broadphase/held/holding_tree.hpp"
#include "scene/primitive_filter.hpp"
#include "tests/broadphase/candidates.hpp"
#include "tests/broadphase/soups.hpp"
#include "tests/catch.hpp"
#include "tests/fuzz.hpp"

using namespace onset;
using namespace onset::tests;
using scenes::Random;

namespace {

constexpr PairKind kKinds[] = {PairKind::vertex_face, PairKind::edge_edge};
constexpr std::size_t kMany = std::size_t(1) << 40;

struct Moving {
  Soup soup;
  Mesh mesh;
  std::vector<bool> is_static;

  explicit Moving(const Soup& s, Random& random, bool with_static) : soup(s), mesh(make(s)) {
    if (!with_static) return;
    CollisionRules rules;
    rules.static_vertices.resize(std::size_t(mesh.num_vertices()));
    for (std::size_t v = 0; v < rules.static_vertices.size();
         v += 3) {  // a triangle each, or one end of a strand
      const bool still = scenes::integer(random, 0, 2) == 0;
      for (std::size_t k = v; k < v + (s.mesh.faces.empty() ? 1 : 3) && k < rules.static_vertices.size(); ++k)
        rules.static_vertices[k] = still;
    }
    is_static = rules.static_vertices;
    mesh.set_rules(rules);
    stand();
  }
  static Mesh make(const Soup& s) {
    Eigen::MatrixXi edges(s.mesh.edges.size(), 2), faces(s.mesh.faces.size(), 3);
    for (Eigen::Index i = 0; i < edges.rows(); ++i)
      for (int k = 0; k < 2; ++k) edges(i, k) = s.mesh.edges[std::size_t(i)][std::size_t(k)];
    for (Eigen::Index i = 0; i < faces.rows(); ++i)
      for (int k = 0; k < 3; ++k) faces(i, k) = s.mesh.faces[std::size_t(i)][std::size_t(k)];
    return Mesh(s.mesh.num_vertices, complete_edges(edges, faces), faces);
  }
  void stand() {
    for (std::size_t i = 0; i < soup.x_t0.size(); ++i)
      if (!is_static.empty() && is_static[i / 3]) soup.x_t1[i] = soup.x_t0[i];
  }
  // Moves every vertex that may move by up to `by`, often by exactly that.
  void jitter(double by, Random& random) {
    for (std::vector<double>* x : {&soup.x_t0, &soup.x_t1})
      for (std::size_t i = 0; i < x->size(); ++i) {
        if (!is_static.empty() && is_static[i / 3]) continue;
        const int way = scenes::integer(random, 0, 3);
        (*x)[i] += way == 0 ? by : way == 1 ? -by : scenes::uniform(random, -by, by);
      }
  }
  void move_statics(double by) {
    for (std::size_t i = 0; i < soup.x_t0.size(); ++i)
      if (!is_static.empty() && is_static[i / 3]) soup.x_t1[i] = soup.x_t0[i] += by;
  }
  Motion motion() const {
    return make_motion(mesh.data(), {soup.x_t0.data(), soup.mesh.num_vertices},
                       {soup.x_t1.data(), soup.mesh.num_vertices});
  }
};

void check(const BroadPhase& held, const BroadPhaseInput& input) {
  BroadPhaseInput plain = input;
  const auto brute = make_broad_phase(BroadPhaseMethod::brute, plain);
  for (const PairKind kind : kKinds) CHECK((candidates(held, kind) == candidates(*brute, kind)));
}

// The hard soups, and each as strands of one edge for each triangle.
std::vector<Soup> soups_and_strands() {
  std::vector<Soup> all = hard_soups();
  for (std::size_t i = 0, count = all.size(); i < count; ++i) {
    Soup strands = all[i];
    strands.name += " as strands";
    strands.mesh.faces.clear(), strands.mesh.edges.clear();
    for (int v = 0; v + 1 < strands.mesh.num_vertices; v += 3) strands.mesh.edges.push_back({v, v + 1});
    all.push_back(strands);
  }
  return all;
}

// The usual size of an edge along an axis.
double edge_of(const Soup& soup) {
  double sum = 0;
  for (const auto& e : soup.mesh.edges)
    sum += std::fabs(soup.x_t0[3 * std::size_t(e[0])] - soup.x_t0[3 * std::size_t(e[1])]);
  return sum / double(std::max<std::size_t>(1, soup.mesh.edges.size()));
}

int sequence(Moving& scene, InstructionSet instruction_set, BoxTest test, Random& random) {
  const double edge = edge_of(scene.soup), inflation = scenes::integer(random, 0, 2) * 0.02 * edge;
  const double step = edge * std::ldexp(1.0, -scenes::integer(random, 6, 40)) * scenes::integer(random, 0, 3);
  std::unique_ptr<BroadPhase> tree;
  int held = 0;
  std::vector<Motion> motions;
  motions.reserve(64);
  const bool alike = scenes::coin(random);  // the calls, which are then put to diagonals before they are held
  for (int call = 0; call < 14; ++call) {
    scene.jitter(call == 7 ? edge : step, random);
    if (call == 4 || call == 11) scene.move_statics(0.3 * edge);
    const Motion& motion = motions.emplace_back(scene.motion());
    REQUIRE(motion.status == Outcome::free);
    BroadPhaseInput input{scene.mesh.data(), motion};
    input.instruction_set = instruction_set;
    input.test = scenes::integer(random, 0, 9) == 0 ? BoxTest(scenes::integer(random, 0, 2)) : test;
    input.inflation = inflation * (1 + scenes::integer(random, 0, 2) * 1e-9);
    input.static_inflation = scene.is_static.empty() ? -1 : 0.5 * inflation;
    input.looks = Looks::at_all;
    input.most_held = kMany;
    input.diagonals = {alike ? call != 9 : scenes::coin(random),
                       scenes::integer(random, 0, 19) == 0 ? Norm::maximum : Norm::euclidean,
                       scenes::integer(random, 0, alike ? 9 : 1) == 0 ? 0 : 0.01 * edge};
    if (input.test == BoxTest::swept) input.diagonals.used = false;
    if (!tree)
      tree = make_holding_tree(input, {});
    else
      tree->refit(input, {});
    INFO(scene.soup.name << ", call " << call << ", " << tree->name());
    held += tree->name() == std::string("held");
    check(*tree, input);
    if (scenes::integer(random, 0, 3) > 0) continue;
    BroadPhaseInput part = input;
    part.t_max = scenes::uniform(random, 0, 1);
    part.test = BoxTest::both_ends;
    tree->refit(part, {});
    check(*tree, part);
  }
  return held;
}

}  // namespace

TEST_CASE("held pairs are those of brute force, in sequences of calls", "[property]") {
  Random which(3);
  int held = 0, calls = 0, turn = 0;
  for (int round = 0; round < fuzz(1); ++round)
    for (const Soup& soup : soups_and_strands())
      for (const bool with_static : {false, true})
        for (const BoxTest test : {BoxTest::both_ends, BoxTest::moving}) {
          if (!is_tried(turn++)) continue;
          const bool scalar = !has_avx2() || scenes::coin(which);
          Random random(std::uint64_t(1000 * round + calls));
          Moving scene(soup, random, with_static);
          held += sequence(scene, scalar ? InstructionSet::scalar : InstructionSet::avx2, test, random);
          calls += 14;
        }
  INFO(held << " of " << calls);
  CHECK(5 * held > calls);
}

// Static vertices without a static primitive: nothing says that they are where they were.
TEST_CASE("a pinned vertex that is moved between calls is seen to have moved", "[unit]") {
  Eigen::MatrixXi strands(4, 2);
  strands << 0, 1, 2, 3, 4, 5, 6, 7;
  Mesh mesh(8, strands, Eigen::MatrixXi(0, 3));
  CollisionRules rules;
  rules.static_vertices.assign(8, false);
  rules.static_vertices[0] = true;
  mesh.set_rules(rules);
  REQUIRE_FALSE(mesh.data().filter->has_static());
  Eigen::MatrixXd x0(8, 3);
  x0 << 0, 0, 0, 1, 0, 0, 0.5, 1, -1, 0.5, 1, 1, -50, -20, -30, -50, -20, -29, 50, 20, 30, 50, 20, 31;
  Eigen::MatrixXd x1 = x0;
  x1(1, 1) += 0.2;
  for (int call = 0; call < 4; ++call) {
    CHECK(construct_active_set(mesh, x0, x1).empty());
    CHECK(compute_collision_free_stepsize(mesh, x0, x1).step == 1);
  }
  x0(0, 1) = x1(0, 1) = 1.9;
  CHECK(construct_active_set(mesh, x0, x1).size() == 1);
  CHECK(compute_collision_free_stepsize(mesh, x0, x1).step < 0.51);
}

TEST_CASE("blocks and counts of held pairs are those of the tree", "[determinism]") {
  Random random(5);
  Moving scene(scattered("many", 2000, 0.05, 0.05, random), random, false);
  const Motion motion = scene.motion();
  BroadPhaseInput input{scene.mesh.data(), motion};
  input.looks = Looks::at_all;
  input.most_held = kMany;
  const auto tree = make_holding_tree(input, {});
  std::vector<IdPairs> blocks;
  const PairKind kind = PairKind::edge_edge;
  for (std::size_t b = 0; b < tree->blocks(kind); ++b)
    blocks.push_back(sorted(emitted(*tree, kind, b, b + 1)));
  tree->refit(input, {});
  REQUIRE(tree->name() == std::string("held"));
  REQUIRE(tree->blocks(kind) == blocks.size());
  for (std::size_t b = 0; b < blocks.size(); ++b)
    CHECK((sorted(emitted(*tree, kind, b, b + 1)) == blocks[b]));
}

TEST_CASE("nothing is held where a call says so, pairs are too many, or positions change much", "[unit]") {
  Random random(6);
  const auto uses_held = [&](double step, std::size_t most, Looks looks) {
    Moving scene(scattered("some", 300, 0.1, 0.1, random), random, false);
    std::vector<Motion> motions(3);
    std::unique_ptr<BroadPhase> tree;
    for (Motion& motion : motions) {
      scene.jitter(step, random);
      motion = scene.motion();
      BroadPhaseInput input{scene.mesh.data(), motion};
      input.looks = looks;
      input.most_held = most;
      if (tree)
        tree->refit(input, {});
      else
        tree = make_holding_tree(input, {});
      check(*tree, input);
    }
    return tree->name() == std::string("held");
  };
  CHECK(uses_held(1e-5, kMany, Looks::at_all));
  CHECK(uses_held(1e-5, kMany, Looks::at_earliest));
  CHECK_FALSE(uses_held(1e-5, kMany, Looks::at_any));
  CHECK_FALSE(uses_held(1e-5, 10, Looks::at_all));
  CHECK_FALSE(uses_held(1e-5, 0, Looks::at_all));
  CHECK_FALSE(uses_held(0.1, kMany, Looks::at_all));
}

TEST_CASE("a call that lets fewer pairs be held than there are uses none", "[unit]") {
  Random random(7);
  Moving scene(scattered("some", 300, 0.1, 0.1, random), random, false);
  const Motion motion = scene.motion();
  BroadPhaseInput input{scene.mesh.data(), motion};
  input.looks = Looks::at_all;
  const auto named = [&](BroadPhase& tree, std::size_t most) {
    input.most_held = most;
    tree.refit(input, {});
    check(tree, input);
    return std::string(tree.name());
  };
  const auto tree = make_holding_tree(input, {});
  CHECK(named(*tree, kMany) == "bvh");
  CHECK(named(*tree, kMany) == "held");
  CHECK(named(*tree, 10) == "bvh");
}
