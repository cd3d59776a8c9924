// Separations of pairs: by bodies, by the shape at rest, and what neighbours are left out.
#include <algorithm>

#include "tests/catch.hpp"
#include "tests/narrowphase/separation.hpp"
#include "tests/oracle/quick.hpp"
#include "tests/scenes/rules.hpp"
#include "tests/src/support/mesh_pairs.hpp"
#include "tests/src/support/scene_set.hpp"

using namespace onset;
using namespace onset::tests;
using scenes::Random;
using scenes::Scene;

namespace {

constexpr int kAcross = 4, kAlong = 24;
constexpr double kEdge = 1.0 / 16, kSeparation = 3 * kEdge;

// A strip with square cells of edge length kEdge, flat.
Scene strip() {
  Scene scene = scenes::cloth(kAlong, kAcross);
  for (int v = 0; v < kAlong * kAcross; ++v)
    scene.x_t0.row(v) << kEdge * (v / kAcross), kEdge * (v % kAcross), 0;
  scene.x_t1 = scene.x_t0;
  return scene;
}

// The strip bent around a half circle in the middle of its length, so that its layers are `apart`.
Eigen::MatrixXd folded(const Eigen::MatrixXd& flat, double apart) {
  const double radius = apart / 2, length = (kAlong - 1) * kEdge, bend = std::acos(-1.0) * radius,
               first = (length - bend) / 2;
  Eigen::MatrixXd x = flat;
  for (Eigen::Index v = 0; v < x.rows(); ++v) {
    const double s = flat(v, 0);
    if (s < first) continue;
    const double angle = (s - first) / radius;
    if (s < first + bend)
      x(v, 0) = first + radius * std::sin(angle), x(v, 2) = radius * (1 - std::cos(angle));
    else
      x(v, 0) = first - (s - first - bend), x(v, 2) = apart;
  }
  return x;
}

// What each pair that meets keeps, at positions where all are listed.
std::vector<ClosePair> all_pairs(const Mesh& mesh, const Eigen::MatrixXd& x, const Options& options) {
  return close_pairs(mesh, x, 1e6, options).pairs;
}

scenes::Query query_at(const Pair& p, const Eigen::MatrixXd& x) { return query_of(p.kind, p.vertices, x, x); }

// Whether a pair is at least this far apart, exactly where that is near.
bool keeps(const scenes::Query& pair, double d, Norm norm) {
  if (oracle::boxes_apart(pair, d) || rough_distance(pair, 0, norm) > d * (1 + 1e-9)) return true;
  return oracle::compare_distance(pair, 0, d, norm) >= 0;
}

// The pairs that keep less than their separation, or than the share of their distance at rest that was asked
// for, less rounding. The distances at rest are those of doubles: within 1e-12 here.
int violations(const std::vector<ClosePair>& pairs, const CollisionRules& rules, const Eigen::MatrixXd& x,
               double separation) {
  int count = 0;
  for (const ClosePair& p : pairs) {
    const double at_rest = rough_distance(query_at(p, rules.rest_positions), 0, Norm::euclidean);
    const double d = std::min(separation, rules.rest_share * at_rest * (1 - 1e-12));
    if (!(p.separation >= d) || !keeps(query_at(p, x), p.separation, Norm::euclidean)) ++count;
  }
  return count;
}

double gap_of_layers(const Eigen::MatrixXd& x) {
  double least = INFINITY;
  for (int v = 0; v < 4 * kAcross; ++v)
    for (int w = (kAlong - 4) * kAcross; w < kAlong * kAcross; ++w)
      least = std::min(least, (x.row(v) - x.row(w)).norm());
  return least;
}

// The fold closes, so that its layers would be `apart`, and every vertex wanders a little.
Eigen::MatrixXd closing(const Eigen::MatrixXd& flat, const Eigen::MatrixXd& x, double apart, Random& random) {
  Eigen::MatrixXd dx = folded(flat, apart) - x;
  for (Eigen::Index i = 0; i < dx.size(); ++i) dx.data()[i] += scenes::uniform(random, -0.02, 0.02) * kEdge;
  return dx;
}

void check_cloth(int rings) {
  const Scene flat = strip();
  CollisionRules rules;
  rules.rest_positions = flat.x_t0, rules.rest_share = 0.5, rules.excluded_rings = rings;
  const Mesh mesh(flat.x_t0, flat.faces, rules), plain(flat.x_t0, flat.faces);
  LineSearchOptions options;
  options.min_separation = kSeparation;
  Eigen::MatrixXd x = folded(flat.x_t0, 5 * kEdge);
  Random random(71);
  const std::vector<ClosePair> pairs = all_pairs(mesh, x, options);
  REQUIRE(std::any_of(pairs.begin(), pairs.end(), [](const auto& p) { return p.separation == kSeparation; }));
  CHECK(std::any_of(pairs.begin(), pairs.end(), [](const auto& p) { return p.separation < kSeparation; }));
  // The mesh is finer than the separation: without the rule nothing may move.
  CHECK(check(plain, x, options).within_separation.size() > 1000);
  CHECK(
      compute_collision_free_stepsize(plain, x, x + closing(flat.x_t0, x, 4 * kEdge, random), options).step ==
      0);
  CHECK(check(mesh, x, options).acceptable());
  double moved = 0;
  for (int i = 0; i < 12; ++i) {
    const Eigen::MatrixXd dx = closing(flat.x_t0, x, (4.75 - 0.25 * i) * kEdge, random);
    const LineSearchStep r = LineSearch(mesh, x, dx, options).largest_step();
    CAPTURE(rings, i, int(r.outcome), r.step);
    CHECK(r.step > 0);
    if (i < 5) CHECK(r.step == 1);
    const StepResult whole = compute_collision_free_stepsize(mesh, x, x + dx, options);
    CHECK((whole.step >= r.step || whole.step == 1));
    x += r.step * dx;
    moved += r.step;
    CHECK(violations(pairs, rules, x, kSeparation) == 0);
  }
  CHECK(moved > 6);
  CHECK(gap_of_layers(x) > kSeparation);
  CHECK(gap_of_layers(x) < 1.1 * kSeparation);
  CHECK(check(mesh, x, options).acceptable());
}

}  // namespace

TEST_CASE("a cloth finer than its separation moves, and its layers stay apart by it", "[oracle]") {
  check_cloth(0);
  check_cloth(2);
}

TEST_CASE("a pair at rest keeps the share of its distance, in either norm", "[oracle]") {
  Random random(72);
  for (const NamedScene& named : some_scenes()) {
    if (named.scene.faces.rows() > 40) continue;
    for (const Norm norm : {Norm::euclidean, Norm::maximum}) {
      CollisionRules rules;
      rules.rest_positions = named.scene.x_t1, rules.rest_share = scenes::uniform(random, 0.1, 0.9);
      const Mesh mesh(named.scene.x_t0, named.scene.faces, rules);
      Options o;
      o.min_separation = 0.3, o.norm = norm;
      const double ratio = norm == Norm::maximum ? std::sqrt(3.0) : 1;
      int lowered = 0, whole = 0;
      for (const ClosePair& p : all_pairs(mesh, named.scene.x_t0, o)) {
        const scenes::Query rest = query_at(p, rules.rest_positions);
        const double d = oracle::distance(rest, 0, norm).lo, most = std::min(0.3, rules.rest_share * d);
        CAPTURE(named.name, int(norm), d, p.separation / ratio, rules.rest_share);
        CHECK(p.separation / ratio <= most * (1 + (norm == Norm::maximum ? 0x1p-48 : 0)));
        CHECK(p.separation / ratio >= most - 0x1p-44);
        ++(p.separation / ratio < 0.29 ? lowered : whole);
      }
      CHECK(lowered + whole > 0);
    }
  }
}

TEST_CASE("pairs that touch at rest have no separation, but do not pass through each other", "[unit]") {
  // Two triangles that are one at rest, 1 apart now, and a third one far away at rest.
  Eigen::MatrixXd x(9, 3), rest;
  x << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1, 0, 0, 2, 1, 0, 2, 0, 1, 2;
  rest = x;
  rest.middleRows(3, 3) = x.topRows(3), rest.bottomRows(3).col(2).setConstant(10);
  Eigen::MatrixXi faces(3, 3);
  faces << 0, 1, 2, 3, 4, 5, 6, 7, 8;
  CollisionRules rules;
  rules.rest_positions = rest;
  const Mesh mesh(x, faces, rules);
  Options o;
  o.min_separation = 0.5;
  Eigen::MatrixXd down = x;
  down.middleRows(3, 3).col(2).setConstant(-1);
  const StepResult touching = compute_collision_free_stepsize(mesh, x, down, o);
  CHECK(touching.step < 0.5);
  CHECK(touching.step > 0.499);
  down.middleRows(3, 3).col(2).setConstant(3);
  const StepResult apart = compute_collision_free_stepsize(mesh, x, down, o);
  CHECK(apart.step < 0.25);
  CHECK(apart.step > 0.249);
}

TEST_CASE("each pair of bodies keeps its own separation", "[unit]") {
  // Four triangles, 1 apart: 0 and 1 keep 0.75, 1 and 2 nothing, 2 and 3 what the call says.
  Eigen::MatrixXd x(12, 3);
  for (int v = 0; v < 12; ++v) x.row(v) << (v % 3 == 1), (v % 3 == 2), v / 3;
  Eigen::MatrixXi faces(4, 3);
  faces << 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11;
  CollisionRules rules;
  rules.bodies = {0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3};
  rules.body_separations = {{1, 0, 0.75}, {1, 2, 0}};
  const Mesh mesh(x, faces, rules);
  Options o;
  o.min_separation = 0.25;
  const auto step = [&](int body, double by) {
    Eigen::MatrixXd there = x;
    there.middleRows(3 * body, 3).col(2).array() += by;
    const StepResult r = compute_collision_free_stepsize(mesh, x, there, o);
    const LineSearchStep s = LineSearch(mesh, x, Eigen::MatrixXd(there - x), o).largest_step();
    CHECK(s.step <= r.step);
    const ActiveSet set = construct_active_set(mesh, x, there, o);
    CHECK(set.empty() == (r.step == 1));
    return r.step * std::abs(by);
  };
  for (const Norm norm : {Norm::euclidean, Norm::maximum}) {
    o.norm = norm;
    CHECK(step(0, 0.5) == Approx(0.25));
    CHECK(step(1, -0.5) == Approx(0.25));
    CHECK(step(1, 2) == Approx(1));
    CHECK(step(2, -2) == Approx(1));
    CHECK(step(3, -2) == Approx(0.75));
    CHECK(step(2, 2) == Approx(0.75));
    CHECK(step(0, -2) == 2);
    for (const ClosePair& p : close_pairs(mesh, x, 0.5, o)) {
      const int first = rules.bodies[std::size_t(p.vertices[0])],
                last = rules.bodies[std::size_t(p.vertices[3])];
      const double d = first + last == 1 ? 0.75 : first + last == 3 ? 0 : 0.25;
      CHECK(p.separation == Approx(d * (norm == Norm::maximum ? std::sqrt(3.0) : 1)));
    }
  }
  o.norm = Norm::euclidean;
  CHECK(check(mesh, x, o).acceptable());
  o.min_separation = 1.5;  // of 0 and 2 and of 2 and 3, and of 0, 1 and 3
  const StartReport report = check(mesh, x, o);
  CHECK(report.within_separation.size() > 0);
  for (const ClosePair& p : report.within_separation) CHECK(p.vertices[0] / 3 + p.vertices[3] / 3 == 5);
  // The thickness is added.
  rules.thickness.assign(12, 0.0625);
  Mesh thick(x, faces, rules);
  o.min_separation = 0.25;
  for (const ClosePair& p : all_pairs(thick, x, o))
    if (rules.bodies[std::size_t(p.vertices[0])] + rules.bodies[std::size_t(p.vertices[3])] == 1)
      CHECK(p.separation == Approx(0.875));
}

TEST_CASE("separations of all pairs of bodies are the separation of a call", "[property]") {
  for (const NamedScene& named : some_scenes()) {
    const Mesh plain = named.mesh();
    CollisionRules rules;
    rules.bodies = plain.components();
    const int bodies = *std::max_element(rules.bodies.begin(), rules.bodies.end()) + 1;
    if (bodies > 200) continue;
    for (int a = 0; a < bodies; ++a)
      for (int b = a; b < bodies; ++b) rules.body_separations.push_back({a, b, 0.01});
    Mesh mesh = plain;
    mesh.set_rules(rules);
    Options o, none;
    o.min_separation = 0.01;
    CAPTURE(named.name);
    CHECK(same_bytes(construct_active_set(mesh, named.scene.x_t0, named.scene.x_t1, none),
                     construct_active_set(plain, named.scene.x_t0, named.scene.x_t1, o)));
    CHECK(same_bytes(compute_collision_free_stepsize(mesh, named.scene.x_t0, named.scene.x_t1, none),
                     compute_collision_free_stepsize(plain, named.scene.x_t0, named.scene.x_t1, o)));
  }
}

TEST_CASE("answers do not depend on what earlier calls found at rest", "[property]") {
  for (const NamedScene& named : some_scenes()) {
    CollisionRules rules;
    rules.rest_positions = named.scene.x_t0, rules.rest_share = 0.7;
    const Eigen::MatrixXd &x0 = named.scene.x_t0, &x1 = named.scene.x_t1;
    Options o, larger;
    o.min_separation = 0.05, larger.min_separation = 0.2;
    const Mesh fresh(x0, named.scene.faces, rules), used(x0, named.scene.faces, rules);
    construct_active_set(used, x0, x1, larger);
    const ActiveSet expected = construct_active_set(fresh, x0, x1, o);
    CAPTURE(named.name);
    CHECK(same_bytes(construct_active_set(used, x0, x1, o), expected));
    used.release_memory();
    o.broad_phase = BroadPhaseMethod::brute, o.threads = 1, o.instruction_set = InstructionSet::scalar;
    CHECK(same_bytes(construct_active_set(used, x0, x1, o), expected));
  }
}

// A vertex with thickness over a face, whose distance at rest allows nearly what thickness and separation ask
// for.
TEST_CASE("what is kept at rest does not depend on earlier calls, to the last bit", "[property]") {
  Random random(oracle::fuzz_seed() * 1000 + 31);
  Eigen::MatrixXi face(1, 3);
  face << 1, 2, 3;
  for (int i = 0; i < oracle::fuzz(2000); ++i) {
    Options o, larger;
    o.min_separation = scenes::uniform(random, 1, 2), larger.min_separation = 2 * o.min_separation;
    o.norm = larger.norm = scenes::coin(random) ? Norm::maximum : Norm::euclidean;
    const double thick = scenes::uniform(random, 1, 2), all = o.min_separation + 2 * thick;
    const double height = 2 * all * (1 + scenes::integer(random, 0, 16) * 0x1p-52);
    Eigen::MatrixXd x(4, 3);
    x << 0, 0, height, -10, -10, 0, 10, -10, 0, 0, 10, 0;
    CollisionRules rules;
    rules.thickness.assign(4, thick), rules.rest_positions = x, rules.rest_share = 0.5;
    const Mesh fresh(4, face, rules), used(4, face, rules);
    close_pairs(used, x, 100, larger);
    const ClosePairs first = close_pairs(fresh, x, 100, o), second = close_pairs(used, x, 100, o);
    REQUIRE((first.size() == 1 && second.size() == 1));
    CHECK(first.pairs[0].separation == second.pairs[0].separation);
  }
}

TEST_CASE("what is found at rest is within the budgets of the call that needs it", "[unit]") {
  const Scene flat = strip();
  CollisionRules rules;
  rules.rest_positions = flat.x_t0;
  const Mesh mesh(flat.x_t0, flat.faces, rules);
  Options o;
  o.min_separation = kSeparation, o.memory_limit = 12 * 100;
  const Eigen::MatrixXd& x = flat.x_t0;
  CHECK(compute_collision_free_stepsize(mesh, x, x, o).outcome == Outcome::out_of_memory);
  CHECK(compute_collision_free_stepsize(mesh, x, x, o).step == 0);
  CHECK(construct_active_set(mesh, x, x, o).outcome == Outcome::out_of_memory);
  CHECK(construct_active_set(mesh, x, x, o).complete_until == 0);
  CHECK(close_pairs(mesh, x, kEdge, o).outcome == Outcome::out_of_memory);
  CHECK_FALSE(is_step_collision_free(mesh, x, x, o));
  CHECK_FALSE(check(mesh, x, o).acceptable());
  CHECK(LineSearch(mesh, x, x * 0, LineSearchOptions(o)).largest_step().step == 0);
  o.memory_limit = Options().memory_limit, o.time_limit = 0;
  CHECK(compute_collision_free_stepsize(mesh, x, x, o).outcome == Outcome::out_of_time);
  o.time_limit = INFINITY;
  CHECK(compute_collision_free_stepsize(mesh, x, x, o).step == 1);
  o.memory_limit = 12 * 100;  // found already, and no less is asked for
  CHECK(compute_collision_free_stepsize(mesh, x, x, o).outcome == Outcome::out_of_memory);
}

TEST_CASE("so many pairs of neighbours that they do not fit are an error", "[unit]") {
  // A star: within two edges, all of its vertices are neighbours.
  Eigen::MatrixXi edges(20000, 2);
  for (int e = 0; e < 20000; ++e) edges.row(e) << 0, e + 1;
  const Eigen::MatrixXi none(0, 3);
  CollisionRules rules;
  rules.excluded_rings = 1;
  const Mesh mesh(20001, edges, none, rules);
  CHECK(mesh.filter_counts().edge_edge.may_meet() == 0);
  rules.excluded_rings = 2;
  CHECK_THROWS_WITH(Mesh(20001, edges, none, rules),
                    Catch::Contains("excluded_rings is 2") && Catch::Contains("134217728"));
}
