// Points that meet wires and each other: exact at separation 0, the closed form with one, and every call.
#include <cmath>

#include "tests/catch.hpp"
#include "tests/fuzz.hpp"
#include "tests/narrowphase/separation.hpp"
#include "tests/scenes/rules.hpp"
#include "tests/src/support/mesh_pairs.hpp"
#include "tests/src/support/scene_set.hpp"

using namespace onset;
using namespace onset::tests;
using scenes::Random;
using scenes::Scene;
using scenes::set_rule;

namespace {

const Eigen::MatrixXi kNoEdges(0, 2), kNoFaces(0, 3);

// A wire from (0, 0, 0) to (1, 0, 0) and a point that falls from (1/2, y, 1) to (1/2, y, -1).
Scene falling_beside(double y) {
  Scene s;
  s.x_t0.resize(3, 3);
  s.x_t0 << 0, 0, 0, 1, 0, 0, 0.5, y, 1;
  s.x_t1 = s.x_t0;
  s.x_t1(2, 2) = -1;
  return s;
}
CollisionRules declared(const std::vector<int>& points) {
  CollisionRules rules;
  rules.points = points;
  return rules;
}
Mesh wire_and_point() { return Mesh(3, Eigen::RowVector2i(0, 1), kNoFaces, declared({2})); }
Mesh two_points() { return Mesh(2, kNoEdges, kNoFaces, declared({1, 0})); }

Eigen::MatrixXd random_points(Random& random, int count, int bits) {
  Eigen::MatrixXd x(count, 3);
  for (int v = 0; v < count; ++v) {
    const Point p = bits > 0 ? scenes::grid_point(random, bits) : scenes::point(random);
    x.row(v) << p[0], p[1], p[2];
  }
  return x;
}

// Wires and two triangles of random vertices, the rest points, all on their way. bits > 0: on a small grid,
// where contacts at separation 0 are exact and many.
struct Mixed {
  Scene scene;
  Mesh mesh;
  Mixed(Random& random, int points, int bits)
      : scene{random_points(random, 14 + points, bits), random_points(random, 14 + points, bits), {}},
        mesh(14 + points, edges(), faces()) {
    std::vector<int> ids;
    for (int v = 14; v < 14 + points; ++v) ids.push_back(v);
    std::reverse(ids.begin(), ids.end());
    set_rule(mesh, &CollisionRules::points, ids);
  }
  static Eigen::MatrixXi edges() {
    Eigen::MatrixXi e(11, 2);
    e << 3, 4, 0, 1, 1, 2, 2, 0, 5, 6, 6, 7, 7, 5, 8, 9, 9, 10, 11, 12, 12, 13;
    return e;
  }
  static Eigen::MatrixXi faces() {
    Eigen::MatrixXi f(2, 3);
    f << 0, 1, 2, 5, 6, 7;
    return f;
  }
};

QueryResult row(const ActiveSet& set, const Key& pair, double tolerance) {
  const std::size_t i = row_of(set, pair);
  QueryResult r;
  if (i == set.size()) return r;
  static_cast<Contact&>(r) = set[i];
  CHECK(r.tolerance <= tolerance);
  return r;
}

bool is_point(const Mesh& mesh, int edge) { return edge >= mesh.num_edges() - mesh.num_points(); }

}  // namespace

TEST_CASE("a point meets a wire exactly, and misses it by a hair", "[unit]") {
  Options o;
  o.tolerance = 1e-9;
  o.exactness = Exactness::exact;
  const Scene hit = falling_beside(0);
  const ActiveSet set = construct_active_set(wire_and_point(), hit.x_t0, hit.x_t1, o);
  REQUIRE(set.size() == 1);
  CHECK(set[0].vertices == std::array<int, 4>{0, 1, 2, 2});
  CHECK((set[0].kind == PairKind::edge_edge && set[0].a == 0 && set[0].b == 1));
  CHECK((set[0].toi == 0.5 && set[0].certainty == Certainty::certain));
  CHECK(set[0].weights == std::array<double, 4>{0.5, 0.5, -1, 0});
  CHECK(set[0].normal == std::array<double, 3>{0, 0, -1});  // the wire was below
  CHECK(set[0].speed == -2);
  CHECK(set[0].degenerate);
  const Mesh undeclared(3, Eigen::RowVector2i(0, 1), kNoFaces);
  CHECK(is_step_collision_free(undeclared, hit.x_t0, hit.x_t1, o));

  for (const double y : {0x1p-30, -0x1p-45, 0x1p-60}) {
    const Scene miss = falling_beside(y);
    CHECK(is_step_collision_free(wire_and_point(), miss.x_t0, miss.x_t1, o));
  }
}

TEST_CASE("a thick wire meets a point where the closed form says so", "[unit]") {
  for (const double y : {0.0, 0.375, -0.375}) {
    const Scene s = falling_beside(y);
    Mesh mesh = wire_and_point();
    Options o;
    o.tolerance = 1e-9;
    o.min_separation = y == 0 ? 0.125 : 0.25;
    set_rule(mesh, &CollisionRules::thickness,
             y == 0 ? std::vector<double>{0, 0.25, 0.125} : std::vector<double>{0.25, 0.125, 0.125});
    const double d = y == 0 ? 0.5 : 0.625, exact = 0.25;  // sqrt(0.625^2 - 0.375^2) = 0.5 above the wire
    const ActiveSet set = construct_active_set(mesh, s.x_t0, s.x_t1, o);
    REQUIRE(set.size() == 1);
    CHECK((set[0].toi <= exact && set[0].toi > exact - 1e-8));
    CHECK(set[0].gap == Approx(d).epsilon(1e-7));
    CHECK(set[0].weights == std::array<double, 4>{0.5, 0.5, -1, 0});
    CHECK(set[0].normal[1] == Approx(-y / d).margin(1e-7));
    CHECK(set[0].normal[2] == Approx(-0.5 / d).margin(1e-7));
    CHECK(compute_collision_free_stepsize(mesh, s.x_t0, s.x_t1, o).toi == set[0].toi);
  }
  const Scene s = falling_beside(0.625 + 1e-6);
  Options o;
  o.tolerance = 1e-9;
  o.min_separation = 0.625;
  CHECK(is_step_collision_free(wire_and_point(), s.x_t0, s.x_t1, o));
}

TEST_CASE("two points meet head-on without a separation, and pass each other otherwise", "[unit]") {
  Scene s;
  s.x_t0.resize(2, 3), s.x_t1.resize(2, 3);
  s.x_t0 << 1, 2, 3, -1, -2, -3;
  s.x_t1 << -3, -6, -9, 0, 0, 0;
  Options o;
  o.exactness = Exactness::exact;
  ActiveSet set = construct_active_set(two_points(), s.x_t0, s.x_t1, o);
  REQUIRE(set.size() == 1);
  CHECK(set[0].vertices == std::array<int, 4>{1, 1, 0, 0});  // in the order of the points
  CHECK((set[0].toi <= 0.4 && set[0].toi_hi >= 0.4 && set[0].toi_hi - set[0].toi < 1e-16));
  CHECK(set[0].weights == std::array<double, 4>{1, 0, -1, 0});
  CHECK(std::hypot(set[0].normal[0], set[0].normal[1], set[0].normal[2]) == Approx(1));
  CHECK(set[0].normal[2] < 0);
  CHECK(set[0].degenerate);
  s.x_t1(1, 1) = 0x1p-40;
  CHECK(is_step_collision_free(two_points(), s.x_t0, s.x_t1, o));

  // The same place from the start, at rest and parting.
  s.x_t0 << 1, 2, 3, 1, 2, 3;
  s.x_t1 = s.x_t0;
  set = construct_active_set(two_points(), s.x_t0, s.x_t1, o);
  REQUIRE(set.size() == 1);
  CHECK((set[0].toi == 0 && set[0].certainty == Certainty::touching_at_start));
  CHECK(std::hypot(set[0].normal[0], set[0].normal[1], set[0].normal[2]) == Approx(1));
  s.x_t1(0, 0) += 1;
  set = construct_active_set(two_points(), s.x_t0, s.x_t1, o);
  REQUIRE(set.size() == 1);
  CHECK(set[0].outcome == PairOutcome::initial_contact);
  o.touching_may_pass_through = true;
  CHECK(construct_active_set(two_points(), s.x_t0, s.x_t1, o)[0].outcome == PairOutcome::initial_separating);
}

TEST_CASE("two points with a separation meet when |p(t)| = d", "[property]") {
  Random random(41);
  int hits = 0, misses = 0;
  for (int i = 0; i < fuzz(400); ++i) {
    Scene s{random_points(random, 2, 0), random_points(random, 2, 0), {}};
    Options o;
    o.tolerance = 1e-10;
    o.min_separation = scenes::uniform(random, 0.1, 0.9);
    const double d = o.min_separation;
    const Eigen::RowVector3d p = s.x_t0.row(1) - s.x_t0.row(0), v = s.x_t1.row(1) - s.x_t1.row(0) - p;
    const double pv = p.dot(v), vv = v.squaredNorm();
    const auto time_of = [&](double distance) {  // the first with |p + t v| = distance
      const double root = pv * pv - vv * (p.squaredNorm() - distance * distance);
      const double t = root < 0 ? INFINITY : (-pv - std::sqrt(root)) / vv;
      return t >= 0 && t <= 1 ? t : INFINITY;
    };
    if (p.norm() < d + 1e-3) continue;
    const double exact = time_of(d), soonest = time_of(d + o.tolerance.value());
    const StepResult r = compute_collision_free_stepsize(two_points(), s.x_t0, s.x_t1, o);
    CAPTURE(i, d, exact, soonest, r.step);
    if (exact < INFINITY) {
      CHECK(r.outcome == Outcome::contact);
      CHECK((r.step <= exact * (1 + 1e-12) && r.step >= soonest * (1 - 1e-9)));
      ++hits;
    } else if (soonest == INFINITY) {
      CHECK((r.outcome == Outcome::free && r.step == 1));
      ++misses;
    }
  }
  CHECK(hits > fuzz(400) / 10);
  CHECK(misses > fuzz(400) / 10);
}

TEST_CASE("points among wires and triangles: each pair keeps the promises, all broad phases agree",
          "[oracle][property][determinism]") {
  Random random(42);
  int hits[2] = {0, 0}, certain = 0;
  for (int round = 0; round < fuzz(24); ++round) {
    const bool grid = round % 2 == 0;
    Mixed m(random, 10, grid ? 1 : 0);
    if (grid && round % 4 == 0) m.scene.x_t1 = -m.scene.x_t0;  // all through one place
    Options o;
    o.tolerance = 1e-7;
    o.min_separation = grid ? 0 : 0.05;
    if (grid) o.exactness = Exactness::exact;
    if (round % 8 == 3) o.norm = Norm::maximum;
    std::vector<double> t(24, 0);
    if (!grid && round % 4 == 1) {
      for (double& x : t) x = scenes::uniform(random, 0, 0.1);
      set_rule(m.mesh, &CollisionRules::thickness, t);
    }
    const ActiveSet set = construct_active_set(m.mesh, m.scene.x_t0, m.scene.x_t1, o);
    Options less = o;
    less.exactness = Exactness::certify;
    const ActiveSet certified = construct_active_set(m.mesh, m.scene.x_t0, m.scene.x_t1, less);
    for_all_pairs(m.mesh, [&](PairKind kind, int a, int b, const std::array<int, 4>& v) {
      if (kind == PairKind::vertex_face || !is_point(m.mesh, b)) return;
      const QueryResult found = row(set, {kind, a, b}, 1e-7);
      Options alone = o;
      alone.min_separation = o.min_separation + thickest(t, v, 0, 2) + thickest(t, v, 2, 4);
      const scenes::Query query = query_of(kind, v, m.scene.x_t0, m.scene.x_t1);
      CAPTURE(round, a, b, v[0], v[1], v[2], v[3]);
      CHECK(broken_promise(query, alone, found) == "");
      hits[is_point(m.mesh, a)] += found.collides();
      if (!grid) return;
      const oracle::Truth truth = oracle::exact_ccd(query);
      CHECK(found.collides() == truth.collides);
      const QueryResult other = row(certified, {kind, a, b}, 1e-7);
      CHECK(broken_promise(query, less, other) == "");
      if (other.certainty != Certainty::within_tolerance)
        CHECK((truth.collides && other.toi_hi >= truth.toi_lo));
      if (!truth.collides) return;
      CHECK(found.certainty != Certainty::within_tolerance);
      CHECK(found.toi_hi >= truth.toi_lo);
      ++certain;
    });
    for (std::size_t i = 0; i < set.size(); ++i)
      for (const std::size_t side : {0u, 2u}) {
        if (set[i].kind == PairKind::vertex_face || !is_point(m.mesh, side == 0 ? set[i].a : set[i].b))
          continue;
        CHECK((std::abs(set[i].weights[side]) == 1 && set[i].weights[side + 1] == 0));
        CHECK((!set[i].degenerate || set[i].gap < 1e-10));
        CHECK(std::hypot(set[i].normal[0], set[i].normal[1], set[i].normal[2]) == Approx(1));
      }
    const StepResult step = compute_collision_free_stepsize(m.mesh, m.scene.x_t0, m.scene.x_t1, o);
    for (const BroadPhaseMethod method :
         {BroadPhaseMethod::hash, BroadPhaseMethod::brute, BroadPhaseMethod::bvh})
      for (const InstructionSet kernel : {InstructionSet::scalar, InstructionSet::automatic}) {
        Options other = o;
        other.broad_phase = method, other.instruction_set = kernel, other.threads = 2;
        CHECK(same_bytes(set, construct_active_set(m.mesh, m.scene.x_t0, m.scene.x_t1, other)));
        CHECK(same_bytes(step, compute_collision_free_stepsize(m.mesh, m.scene.x_t0, m.scene.x_t1, other)));
      }
  }
  CHECK((hits[0] > fuzz(24) * 5 && hits[1] > fuzz(24) && certain > fuzz(24)));
}

TEST_CASE("the plan counts points as edges, with and without rules", "[property]") {
  Random random(43);
  for (int rules = 0; rules < 5; ++rules) {
    Mixed m(random, 7, 0);
    const int vertices = int(m.mesh.num_vertices());
    if (rules == 1) {
      std::vector<bool> fixed(std::size_t(vertices), false);
      for (int v : {5, 6, 7, 14, 15, 16}) fixed[std::size_t(v)] = true;
      set_rule(m.mesh, &CollisionRules::static_vertices, fixed);
      m.scene.x_t1 = m.scene.x_t0;
    }
    if (rules >= 2) set_rule(m.mesh, &CollisionRules::bodies, m.mesh.components());
    const std::vector<bool> all_bodies(std::size_t(m.mesh.num_bodies()), true);
    if (rules == 2) set_rule(m.mesh, &CollisionRules::rigid_bodies, all_bodies);
    if (rules == 3)
      set_rule(m.mesh, &CollisionRules::excluded_bodies,
               {{0, m.mesh.body(14)}, {m.mesh.body(15), m.mesh.body(16)}});
    if (rules == 4) set_rule(m.mesh, &CollisionRules::excluded_vertices, {{3, 14}, {15, 16}, {0, 17}});
    Options o;
    o.min_separation = 100;  // all are candidates
    const Candidates all = compute_candidates(m.mesh, m.scene.x_t0, m.scene.x_t1, o);
    const FilterCounts& plan = m.mesh.filter_counts();
    CAPTURE(rules);
    CHECK(plan.edge_edge.pairs == 18 * 17 / 2);
    if (rules == 0) CHECK(plan.edge_edge.adjacent == 8);  // three a triangle, and two chains of two wires
    CHECK(plan.edge_edge.may_meet() == all.counts.edge_edge);
    CHECK(plan.vertex_face.may_meet() == all.counts.vertex_face);
    CHECK(plan.edges.moving + plan.edges.statics + plan.edges.dropped == 18);
  }
}

TEST_CASE("points in distance sets, line searches, listed pairs and constraints", "[unit]") {
  Random random(44);
  int near_points = 0;
  for (int round = 0; round < 12; ++round) {
    Mixed m(random, 10, 0);
    const Eigen::MatrixXd &x = m.scene.x_t0, dx = m.scene.x_t1 - x;
    Options o;
    o.min_separation = 0.01;
    const double d_hat = 0.3;
    const ClosePairs close = close_pairs(m.mesh, x, d_hat, o);
    std::size_t next = 0;
    for_all_pairs(m.mesh, [&](PairKind kind, int a, int b, const std::array<int, 4>& v) {
      const double distance = oracle::distance(query_of(kind, v, x, x), 0).lo;
      if (std::abs(distance - d_hat - 0.01) < 1e-9) return;
      const bool listed = next < close.size() && close.pairs[next].kind == kind && close.pairs[next].a == a &&
                          close.pairs[next].b == b;
      CHECK(listed == (distance < d_hat + 0.01));
      if (!listed) return;
      const ClosePair& p = close.pairs[next++];
      CHECK(p.distance == Approx(distance).epsilon(1e-12));
      if (kind == PairKind::vertex_face || !is_point(m.mesh, b)) return;
      CHECK((p.weights[2] == -1 && p.weights[3] == 0));
      Eigen::RowVector3d apart = Eigen::RowVector3d::Zero();
      for (std::size_t k = 0; k < 4; ++k) apart += p.weights[k] * x.row(p.vertices[k]);
      CHECK(apart.norm() == Approx(distance).epsilon(1e-12));
      ++near_points;
    });
    CHECK(next == close.size());

    const StepResult step = compute_collision_free_stepsize(m.mesh, x, m.scene.x_t1, o);
    const Candidates all = compute_candidates(m.mesh, x, m.scene.x_t1, o);
    CHECK(compute_collision_free_stepsize(m.mesh, all, x, m.scene.x_t1, o).step == step.step);
    const double cfl = compute_cfl_stepsize(m.mesh, x, m.scene.x_t1, close, o).step;
    CHECK(cfl <= step.step);
    CHECK(safe_step(safe_distances(m.mesh, x, close), dx) <= step.step);
    LineSearchOptions search_options = o;
    search_options.d_hat = d_hat;
    const LineSearch search(m.mesh, x, dx, search_options);
    const LineSearchStep s = search.largest_step();
    CHECK(s.step <= step.step);
    if (step.step > 0) {
      CHECK(s.step > 0);
      CHECK(close_pairs(m.mesh, x + s.step * dx, d_hat, o).size() <= search.close_pairs(s.step).size());
      CHECK(is_step_collision_free(m.mesh, x, x + s.step * dx, o));
    }

    const ActiveSet set = construct_active_set(m.mesh, x, m.scene.x_t1, o);
    const Constraints c = assemble_constraints(set, 0.01);
    for (std::size_t i = 0; i < set.size(); ++i) {
      double sum = 0;
      const Eigen::MatrixXd at = x + set[i].toi * dx;
      for (std::size_t k = 12 * i; k < 12 * i + 12; ++k) sum += c.value[k] * at(c.dof[k] / 3, c.dof[k] % 3);
      CHECK(sum == Approx(set[i].gap).epsilon(1e-6));
    }
  }
  CHECK(near_points > 50);
}
