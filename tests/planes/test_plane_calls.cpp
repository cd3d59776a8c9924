// Planes in every call, and beside other pairs.
#include <algorithm>
#include <limits>

#include "tests/catch.hpp"
#include "tests/narrowphase/kernel/kernels.hpp"
#include "tests/oracle/promises.hpp"
#include "tests/planes/plane_scenes.hpp"
#include "tests/planes/plane_truth.hpp"
#include "tests/scenes/meshes.hpp"
#include "tests/src/support/answer.hpp"

using namespace onset;
using namespace onset::tests;
using scenes::Random;

namespace {

// A cloth over a ground that it falls through, crumpled.
scenes::Scene falling_cloth(int n, Random& random) {
  scenes::Scene s = scenes::cloth(n, n);
  scenes::shake(s, 0.3, random);
  s.x_t1.col(2).array() -= 1;
  return s;
}

CollisionRules ground(double height, std::array<double, 3> normal = {0, 0, 1}) {
  CollisionRules rules;
  rules.planes.push_back({normal, height});
  return rules;
}

// A face, with a vertex above it, that all stand over the ground.
struct OverGround {
  Eigen::MatrixXd x{4, 3}, y;
  Eigen::MatrixXi faces{1, 3};
  OverGround(double vertex, double face) {
    x << 0, 0, vertex, 1, 0, face, 0, 1, face, -1, -1, face;
    faces << 1, 2, 3;
    y = x;
  }
};

std::vector<std::array<int, 2>> ids(const std::vector<Pair>& pairs) {
  std::vector<std::array<int, 2>> all;
  for (const Pair& p : pairs) all.push_back({p.a, p.b});
  return all;
}

}  // namespace

TEST_CASE("close pairs, starts and intersections have the planes that exact arithmetic has",
          "[planes][oracle]") {
  Random random(oracle::fuzz_seed() * 1000 + 76);
  int close_count = 0, behind_count = 0, within_count = 0;
  for (int i = 0; i < oracle::fuzz(400); ++i) {
    const PlaneScene s = random_plane_scene(random, scenes::coin(random));
    const Mesh mesh = s.mesh();
    const double d_hat =
        std::max(std::min(s.x_t0.cwiseAbs().maxCoeff() * scenes::power_of_ten(random, -9, 0), 1e300), 1e-320);
    const ClosePairs close = close_pairs(mesh, s.x_t0, d_hat, s.options);
    const StartReport report = check(mesh, s.x_t0, s.options);
    const Intersections behind = intersections(mesh, s.x_t0, s.options);
    std::vector<std::array<int, 2>> expected_touching, expected_within, within;
    for (int v = 0; v < s.x_t0.rows(); ++v)
      for (std::size_t p = 0; p < s.rules.planes.size(); ++p) {
        const HalfSpaceTruth truth(s.rules.planes[p], s.options.min_separation, s.options.norm);
        const Rational f = truth.value(s.x_t0.row(v));
        if (oracle::sign(f) <= 0)
          expected_touching.push_back({v, int(p)});
        else if (truth.side(f) <= 0)
          expected_within.push_back({v, int(p)});
        const auto at = std::find_if(close.begin(), close.end(), [&](const ClosePair& c) {
          return c.kind == PairKind::vertex_plane && c.a == v && c.b == int(p);
        });
        const HalfSpaceTruth near(s.rules.planes[p], s.options.min_separation + d_hat, Norm::euclidean);
        INFO("vertex " << v << " and plane " << p << ", d_hat " << d_hat);
        if (near.side(f) < 0) CHECK(at != close.end());
        if (at == close.end()) continue;
        ++close_count;
        const Rational distance(at->distance), smallest(0x1p-1074);
        const Rational high = distance * Rational(1 + 0x1p-47) + smallest;
        Rational low = distance * Rational(1 - 0x1p-47) - smallest;
        if (oracle::sign(low) < 0) low = 0;
        const Rational squared = oracle::sign(f) <= 0 ? Rational(0) : Rational(f * f);
        CHECK(low * low * truth.length_squared() <= squared);
        CHECK(high * high * truth.length_squared() >= squared);
        CHECK((at->weights == std::array<double, 4>{1, 0, 0, 0} && at->gap >= 0));
        const Rational beyond = Rational(at->gap) + Rational(at->gap > 0 ? at->separation : 0);
        CHECK(beyond * beyond * truth.length_squared() <= squared);
      }
    for (const ClosePair& p : report.within_separation) within.push_back({p.a, p.b});
    CHECK(ids(report.touching) == expected_touching);
    CHECK(within == expected_within);
    CHECK(behind.behind_planes == expected_touching);
    CHECK(has_intersections(mesh, s.x_t0, s.options) == !expected_touching.empty());
    CHECK(report.acceptable() == (expected_touching.empty() && expected_within.empty()));
    behind_count += int(expected_touching.size()), within_count += int(expected_within.size());
  }
  const int some = oracle::fuzz(400) / 4;
  CHECK((close_count > some && behind_count > some && within_count > some / 5));
}

TEST_CASE("planes give the same bytes for any threads and instruction set", "[planes][determinism][simd]") {
  Random random(77);
  const scenes::Scene s = falling_cloth(16, random);
  for (const double separation : {0.0, 0.01}) {
    CollisionRules rules = ground(-0.6);
    rules.planes.push_back({{1, 2, 3}, -2.5});
    rules.planes.push_back({{-1, 0, 0.25}, -60});
    const Mesh mesh(s.x_t0, s.faces, rules);
    std::optional<std::uint64_t> first;
    for (const InstructionSet kernel : kernels())
      for (const int threads : {1, 2, 4}) {
        LineSearchOptions o;
        o.threads = threads, o.instruction_set = kernel, o.min_separation = separation, o.d_hat = 0.05;
        Answer a;
        const ActiveSet set = construct_active_set(mesh, s.x_t0, s.x_t1, o);
        a.add(set, compute_collision_free_stepsize(mesh, s.x_t0, s.x_t1, o));
        a.add(compute_candidates(mesh, s.x_t0, s.x_t1, o), close_pairs(mesh, s.x_t0, 0.05, o));
        const LineSearch search(mesh, s.x_t0, s.x_t1 - s.x_t0, o);
        a.add(search.largest_step(), search.close_pairs(0.5), check(mesh, s.x_t1, o));
        if (!first) {
          first = a.hash();
          CHECK(set.stats.contacts.vertex_plane > 100);
          CHECK(set.stats.contacts.total() == std::int64_t(set.size()));
        }
        CAPTURE(threads, to_string(kernel));
        CHECK(a.hash() == *first);
      }
  }
}

TEST_CASE("a scene has the contacts of its pairs and those of its planes", "[planes]") {
  Random random(78);
  const scenes::Scene s = falling_cloth(12, random);
  const Mesh without(s.x_t0, s.faces), with(s.x_t0, s.faces, ground(-0.4));
  const ActiveSet pairs = construct_active_set(without, s.x_t0, s.x_t1),
                  all = construct_active_set(with, s.x_t0, s.x_t1);
  REQUIRE((pairs.size() > 0 && all.size() > pairs.size()));
  Answer some, same;
  for (const Contact& c : pairs) some.add(c);
  for (const Contact& c : all)
    if (c.kind != PairKind::vertex_plane) same.add(c);
  CHECK(some == same);
  CHECK(all.contacts.back().kind == PairKind::vertex_plane);
  const StepResult step = compute_collision_free_stepsize(with, s.x_t0, s.x_t1);
  CHECK(step.toi == all.earliest()->toi);
  Options window;
  window.window = 0.1;
  const ActiveSet early = construct_active_set(with, s.x_t0, s.x_t1, window);
  Answer expected, got;
  for (const Contact& c : all)
    if (c.toi <= all.earliest()->toi + 0.1) expected.add(c);
  for (const Contact& c : early) got.add(c);
  CHECK(expected == got);
  Options few;
  few.memory_limit = 256 * 5;
  const ActiveSet cut = construct_active_set(with, s.x_t0, s.x_t1, few);
  CHECK((cut.size() == 5 && cut.outcome == Outcome::out_of_memory));
  for (const Contact& c : cut) CHECK(c.toi <= cut.complete_until);
}

TEST_CASE("of a pair and a plane at one time the pair is named, of two planes the first", "[planes]") {
  OverGround s(2, 1);
  s.y.row(0)[2] = 0, s.y.bottomRows(3).col(2).setConstant(1);
  CollisionRules rules = ground(1, {0, 0, 1});
  rules.planes[0].offset = 1;
  rules.static_vertices = {false, true, true, true};
  const Mesh tie(s.x, s.faces, rules);
  Options exact;
  exact.exactness = Exactness::exact;
  const StepResult r = compute_collision_free_stepsize(tie, s.x, s.y, exact);
  CHECK(r.toi == 0.5);
  const ActiveSet set = construct_active_set(tie, s.x, s.y, exact);
  REQUIRE(set.size() == 2);
  CHECK((set[0].kind == PairKind::vertex_face && set[1].kind == PairKind::vertex_plane));
  CHECK(set.earliest() == &set[0]);
  CHECK(set[1].toi == set[1].toi_hi);
  rules.planes = {{{0, 0, 3}, 3}, {{0, 0, 1}, 1}};
  const Mesh two(4, Eigen::MatrixXi(0, 3), rules);
  const StepResult first = compute_collision_free_stepsize(two, s.x, s.y);
  REQUIRE(first.limiting);
  CHECK((first.limiting->a == 0 && first.limiting->b == 0));
  CHECK(first.limiting->vertices == std::array<int, 4>{0, -1, -1, -1});
}

TEST_CASE("rules keep vertices and planes apart", "[planes]") {
  OverGround s(2, 1);
  s.y.col(2).array() -= 5;
  const auto contacts = [&](const CollisionRules& rules) {
    std::vector<int> vertices;
    for (const Contact& c : construct_active_set(Mesh(s.x, s.faces, rules), s.x, s.y))
      if (c.kind == PairKind::vertex_plane) vertices.push_back(c.a);
    return vertices;
  };
  CollisionRules rules = ground(0);
  CHECK(contacts(rules) == std::vector<int>{0, 1, 2, 3});
  rules.excluded_pairs = {{PairKind::vertex_plane, 2, 0, {}}};
  CHECK(contacts(rules) == std::vector<int>{0, 1, 3});
  rules.groups = {1, 2, 2, 2}, rules.masks = {3, 3, 3, 3};
  rules.planes[0].mask = 2;
  CHECK(contacts(rules) == std::vector<int>{1, 3});
  s.y.row(3) = s.x.row(3);
  rules.static_vertices = {false, false, false, true};
  s.x(3, 2) = s.y(3, 2) = -1;
  CHECK(contacts(rules) == std::vector<int>{1});
}

TEST_CASE("constraints keep vertices in front of planes", "[planes]") {
  OverGround s(2, 1);
  s.y.col(2).array() -= 5;
  const Mesh mesh(s.x, s.faces, ground(1, {0, 0, 2}));
  ActiveSet set = construct_active_set(mesh, s.x, s.y);
  const Constraints c = assemble_constraints(set, 0.25);
  REQUIRE((c.rows() == 4 && c.value.size() == 48));
  for (std::size_t r = 0; r < 4; ++r) {
    CHECK(c.bound[r] == 0.75);
    double sum = 0;
    for (std::size_t k = 12 * r; k < 12 * r + 12; ++k) sum += c.value[k] * (c.dof[k] % 3 == 2 ? 0.75 : 7);
    CHECK(sum == 0.75);
  }
  set.planes.clear();
  CHECK_THROWS_WITH(assemble_constraints(set), "a contact is with plane 0; the set has 0");
}

TEST_CASE("steps by distances count planes in", "[planes]") {
  OverGround s(3, 1);
  s.y.col(2).array() -= 0.5;
  const Mesh mesh(s.x, s.faces, ground(0.75));
  const ClosePairs close = close_pairs(mesh, s.x, 0.7);
  REQUIRE(close.size() == 3);
  CHECK(close.pairs[0].distance == 0.25);
  const std::vector<double> safe = safe_distances(mesh, s.x, close);
  CHECK((safe[1] > 0.124 && safe[1] <= 0.125 && safe[0] <= 0.35));
  const StepResult r = compute_cfl_stepsize(mesh, s.x, s.y, close);
  CHECK((r.step > 0.39 && r.step <= 0.4 && r.toi == 0.5));
  REQUIRE(r.limiting);
  CHECK(r.limiting->kind == PairKind::vertex_plane);
}

TEST_CASE("what is touching may leave a plane where that is asked for", "[planes]") {
  OverGround s(3, 0);
  s.y.col(2).array() += 1;
  const Mesh mesh(s.x, s.faces, ground(0));
  const StepResult blocked = compute_collision_free_stepsize(mesh, s.x, s.y);
  CHECK((blocked.step == 0 && blocked.outcome == Outcome::initial_contact));
  Options o;
  o.touching_may_pass_through = true;
  CHECK(compute_collision_free_stepsize(mesh, s.x, s.y, o).step == 1);
  CHECK(is_step_collision_free(mesh, s.x, s.y, o));
  s.y.col(2).array() -= 2;
  CHECK(compute_collision_free_stepsize(mesh, s.x, s.y, o).step == 0);
}

TEST_CASE("bad planes are named", "[planes]") {
  const auto made = [](const CollisionRules& rules) { return Mesh(2, Eigen::MatrixXi(0, 3), rules); };
  CollisionRules rules = ground(0);
  rules.planes.push_back({{0, 0, 0}, 1});
  CHECK_THROWS_WITH(made(rules), "planes row 1: its normal is 0");
  rules.planes[1].normal = {1, INFINITY, 0};
  CHECK_THROWS_WITH(made(rules), "planes row 1: its normal is not finite");
  rules.planes[1] = {{1, 0, 0}, std::numeric_limits<double>::quiet_NaN()};
  CHECK_THROWS_WITH(made(rules), "planes row 1: its offset is not finite");
  rules.planes.pop_back();
  rules.excluded_pairs = {{PairKind::vertex_plane, 1, 1, {}}};
  CHECK_THROWS_WITH(made(rules), "excluded_pairs row 0: plane 1 is out of range, there are 1 planes");
  rules.excluded_pairs = {};
  Candidates listed;
  listed.vertex_plane = {{0, 0}, {2, 0}};
  const Eigen::MatrixXd x = Eigen::MatrixXd::Ones(2, 3);
  CHECK_THROWS_WITH(compute_collision_free_stepsize(made(rules), listed, x, x),
                    "vertex_plane row 1: the mesh has no pair 2, 0");
}

TEST_CASE("calls with planes end where they are told to", "[planes]") {
  Random random(79);
  const scenes::Scene s = falling_cloth(60, random);
  const Mesh mesh(s.x_t0, s.faces, ground(-0.5));
  Options o;
  int asked = 0;
  o.progress = [&](double) { return ++asked < 2; };
  CHECK(compute_collision_free_stepsize(mesh, s.x_t0, s.x_t1, o).outcome == Outcome::cancelled);
  Options none;
  none.time_limit = 0;
  CHECK(construct_active_set(mesh, s.x_t0, s.x_t1, none).outcome == Outcome::out_of_time);
  Options small;
  small.memory_limit = 80;
  const Candidates few = compute_candidates(mesh, s.x_t0, s.x_t1, small);
  CHECK((few.outcome == Outcome::out_of_memory && few.vertex_plane.empty() && few.counts.vertex_plane > 10));
  Eigen::MatrixXd bad = s.x_t1;
  bad(5, 1) = std::numeric_limits<double>::quiet_NaN();
  CHECK(compute_collision_free_stepsize(mesh, s.x_t0, bad).outcome == Outcome::non_finite);
}

TEST_CASE("the separation from a plane is min_separation and thickness, rounded up where it must be",
          "[planes]") {
  const auto contacts = [](double separation, double thickness, double end) {
    CollisionRules rules = ground(0);
    rules.thickness = {thickness, 0.125};
    const Mesh mesh(2, Eigen::MatrixXi(0, 3), rules);
    Eigen::MatrixXd x(2, 3), x_new(2, 3);
    x << 0, 0, 1, 9, 0, 9;
    x_new << 0, 0, end, 9, 0, 9;
    Options o;
    o.min_separation = separation;
    CHECK((check(mesh, x_new, o).within_separation.empty()) ==
          construct_active_set(mesh, x, x_new, o).empty());
    return construct_active_set(mesh, x, x_new, o).size();
  };
  const double above = std::nextafter(0.25, 1);
  CHECK(contacts(0, 0.25, above) == 0);
  CHECK(contacts(0, 0.25, 0.25) == 1);
  CHECK(contacts(0.125, 0.125, above) == 0);
  CHECK(contacts(0.25, 0, above) == 0);
  // 0.25 + 2^-60 is no double: more than 0.25 is kept.
  CHECK(contacts(0.25, 0x1p-60, 0.25) == 1);
  CHECK(contacts(0.25, 0x1p-60, std::nextafter(above, 1)) == 0);
  CHECK(contacts(0x1p-60, 0.25, above) == 1);
}
