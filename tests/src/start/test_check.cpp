// What is said about a start, against exact arithmetic; and that the calls it names cure it.
#include <algorithm>
#include <onset/onset.hpp>

#include "src/start/places.hpp"
#include "tests/asks.hpp"
#include "tests/catch.hpp"
#include "tests/oracle/distance.hpp"
#include "tests/oracle/oracle.hpp"
#include "tests/oracle/promises.hpp"
#include "tests/scenes/rules.hpp"
#include "tests/src/support/crowds.hpp"
#include "tests/src/support/mesh_pairs.hpp"

using namespace onset;
using namespace onset::tests;
using oracle::Rational;
using scenes::Random;
using scenes::set_rule;

namespace {

std::vector<Key> keys(const std::vector<Pair>& pairs) {
  std::vector<Key> all;
  for (const Pair& p : pairs) all.push_back({p.kind, p.a, p.b});
  return all;
}
bool equal(const std::vector<Key>& p, const std::vector<Key>& q) {
  return std::equal(p.begin(), p.end(), q.begin(), q.end(),
                    [](const Key& a, const Key& b) { return !(a < b) && !(b < a); });
}

// On the axis on which the boxes are farthest apart, no more than the distance in either norm up to rounding.
double box_distance(const Eigen::MatrixXd& x, const std::array<int, 4>& v, int side) {
  double widest = -INFINITY;
  for (int a = 0; a < 3; ++a) {
    double lo[2] = {INFINITY, INFINITY}, hi[2] = {-INFINITY, -INFINITY};
    for (int i = 0; i < 4; ++i) {
      const double c = x(v[std::size_t(i)], a);
      lo[i >= side] = std::min(lo[i >= side], c), hi[i >= side] = std::max(hi[i >= side], c);
    }
    widest = std::max({widest, lo[0] - hi[1], lo[1] - hi[0]});
  }
  return widest;
}

// Points ({v, v}) as oracle queries are edges of length zero; for_all_pairs leaves out none of them.
std::vector<Key> touching_pairs(const Crowd& crowd) {
  std::vector<Key> all;
  for_all_pairs(crowd.mesh, [&](PairKind kind, int a, int b, const std::array<int, 4>& v) {
    if (oracle::compare_distance(query_of(kind, v, crowd.x, crowd.x), 0, 0) == 0) all.push_back({kind, a, b});
  });
  return all;
}

const StartFinding* finding(const StartReport& report, StartFault fault) {
  for (const StartFinding& f : report.findings)
    if (f.fault == fault) return &f;
  return nullptr;
}
bool says(const StartReport& report, StartFault fault, const char* words) {
  const StartFinding* f = finding(report, fault);
  if (f) INFO(f->text);
  return f && f->text.find(words) != std::string::npos;
}

// Two triangles side by side, the seam between them in copies: 1 and 3, 2 and 5.
struct Seam {
  Eigen::MatrixXd x{6, 3};
  Eigen::MatrixXi F{2, 3};
  Seam() {
    x << 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0;
    F << 0, 1, 2, 3, 4, 5;
  }
};

}  // namespace

TEST_CASE("touching pairs are those at distance zero, exactly", "[oracle][property]") {
  Random random(90 + oracle::fuzz_seed());
  std::size_t found[2] = {};
  for (int round = 0; round < std::max(6, oracle::fuzz(12)); ++round) {
    const Crowd crowd = some_crowd(round, random);
    INFO(crowd.name << ", round " << round);
    const std::vector<Key> expected = touching_pairs(crowd);
    for (const BroadPhaseMethod method :
         {BroadPhaseMethod::bvh, BroadPhaseMethod::hash, BroadPhaseMethod::brute}) {
      Options o;
      o.broad_phase = method;
      const StartReport report = check(crowd.mesh, crowd.x, o);
      CHECK(report.outcome == Outcome::free);
      CHECK(equal(keys(report.touching), expected));
      CHECK(report.within_separation.empty());
      CHECK(report.intersections.size() == intersections(crowd.mesh, crowd.x).size());
      CHECK(report.acceptable() == (expected.empty() && report.intersections.empty()));
    }
    for (const Key& k : expected) ++found[std::size_t(k.kind)];
  }
  CHECK((found[0] > 30 && found[1] > 30));
}

TEST_CASE("pairs within the separation are those that come as close, in either norm", "[oracle][property]") {
  Random random(91 + oracle::fuzz_seed());
  std::size_t found[2] = {}, beyond_by_rounding = 0;
  for (int round = 0; round < std::max(6, oracle::fuzz(12)); ++round) {
    Crowd crowd = round % 2 ? grid_crowd(10, 3, random) : some_crowd(round / 2, random);
    std::vector<double> thickness(std::size_t(crowd.mesh.num_vertices()), 0);
    if (round % 3 == 0)
      for (double& t : thickness) t = scenes::integer(random, 0, 2) / 32.0;
    set_rule(crowd.mesh, &CollisionRules::thickness, thickness);
    Options o;
    o.min_separation = scenes::integer(random, 1, 12) / 32.0;
    o.norm = round % 4 < 2 ? Norm::euclidean : Norm::maximum;
    const StartReport report = check(crowd.mesh, crowd.x, o);
    std::vector<Key> listed;
    for (const ClosePair& p : report.within_separation) listed.push_back({p.kind, p.a, p.b});
    std::vector<Key> touching = keys(report.touching);
    for_all_pairs(crowd.mesh, [&](PairKind kind, int a, int b, const std::array<int, 4>& v) {
      const scenes::Query q = query_of(kind, v, crowd.x, crowd.x);
      const int side = kind == PairKind::vertex_face ? 1 : 2;
      const double d = o.min_separation + thickest(thickness, v, 0, side) + thickest(thickness, v, side, 4);
      const bool touches = std::binary_search(touching.begin(), touching.end(), Key{kind, a, b});
      const bool is_listed = std::binary_search(listed.begin(), listed.end(), Key{kind, a, b});
      if (box_distance(crowd.x, v, side) > 1.001 * d) {
        CHECK_FALSE((touches || is_listed));
        return;
      }
      const int against = oracle::compare_distance(q, 0, d, o.norm);
      if (against <= 0) CHECK((touches || is_listed));
      if (against > 0) CHECK_FALSE(touches);
      if (is_listed && against > 0) {
        ++beyond_by_rounding;
        CHECK(oracle::compare_distance(q, 0, d * (1 + 1e-7), o.norm) < 0);
      }
      found[o.norm == Norm::maximum] += is_listed;
    });
  }
  CHECK((found[0] > 30 && found[1] > 30));
  CHECK(beyond_by_rounding < (found[0] + found[1]) / 4);
}

TEST_CASE("the copies of a seam are named, and either call that joins them makes the start clean", "[unit]") {
  const Seam seam;
  Mesh mesh(seam.x, seam.F);
  const StartReport report = check(mesh, seam.x);
  CHECK(report.copied_vertices == std::vector<std::array<int, 2>>{{1, 3}, {2, 5}});
  CHECK(duplicate_vertices(seam.x) == report.copied_vertices);
  CHECK(says(report, StartFault::copied_vertices, "rules.weld = true"));
  CHECK(says(report, StartFault::copied_vertices, "first vertices 1 and 3"));
  CHECK(says(report, StartFault::copied_vertices, "rules.excluded_vertices = onset::duplicate_vertices(x)"));
  CHECK_FALSE(
      (report.acceptable() || report.clean() || report.touching.empty() || report.intersections.empty()));
  set_rule(mesh, &CollisionRules::weld, true);
  CHECK(check(mesh, seam.x).clean());
  set_rule(mesh, &CollisionRules::weld, false);
  set_rule(mesh, &CollisionRules::excluded_vertices, duplicate_vertices(seam.x));
  CHECK(check(mesh, seam.x).clean());
  set_rule(mesh, &CollisionRules::excluded_vertices, {});
  set_rule(mesh, &CollisionRules::rigid_bodies, {true});
  CHECK(check(mesh, seam.x).clean());
  set_rule(mesh, &CollisionRules::rigid_bodies, {});
  set_rule(mesh, &CollisionRules::static_vertices, std::vector<bool>(6, true));
  CHECK(check(mesh, seam.x).clean());
  set_rule(mesh, &CollisionRules::static_vertices, {false, true, true, true, false, true});  // the copies
  CHECK(check(mesh, seam.x).copied_vertices.size() == 2);
  set_rule(mesh, &CollisionRules::static_vertices, std::vector<bool>(6));
  set_rule(mesh, &CollisionRules::bodies, mesh.components());
  set_rule(mesh, &CollisionRules::excluded_bodies, {{0, 1}});
  CHECK(check(mesh, seam.x).clean());
  set_rule(mesh, &CollisionRules::excluded_bodies, {});
  CHECK(check(mesh, seam.x).copied_vertices.size() == 2);
}

TEST_CASE("all copies at one place count as one vertex, however many", "[unit]") {
  Eigen::MatrixXd x(15, 3);  // five triangles around one point that is in each as a copy
  Eigen::MatrixXi F(5, 3);
  for (int f = 0; f < 5; ++f) {
    x.row(3 * f) << (f % 2 ? 0.0 : -0.0), 0, 2;
    x.row(3 * f + 1) << std::cos(f), std::sin(f), 0;
    x.row(3 * f + 2) << std::cos(f + 0.5), std::sin(f + 0.5), 0;
    F.row(f) << 3 * f, 3 * f + 1, 3 * f + 2;
  }
  Mesh mesh(x, F);
  const auto pairs = duplicate_vertices(x);
  CHECK(pairs.size() == 10);
  CHECK(std::is_sorted(pairs.begin(), pairs.end()));
  CHECK(check(mesh, x).copied_vertices == std::vector<std::array<int, 2>>{{0, 3}, {0, 6}, {0, 9}, {0, 12}});
  set_rule(mesh, &CollisionRules::excluded_vertices, {{0, 3}, {0, 6}, {0, 9}});
  CHECK(check(mesh, x).copied_vertices == std::vector<std::array<int, 2>>{{0, 12}, {3, 6}, {3, 9}});
  CHECK_FALSE(check(mesh, x).acceptable());
  set_rule(mesh, &CollisionRules::excluded_vertices, pairs);
  CHECK(check(mesh, x).clean());
}

TEST_CASE("a pierced start, faces without area and vertices of nothing are named, with the call to make",
          "[unit]") {
  Eigen::MatrixXd x(8, 3);
  x << 0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, -1, 1, 1, 1, /* a corner on a side */ 9, 9, 8, 9, 9, 9, 9, 9, 10;
  Eigen::MatrixXi wire(1, 2), F(2, 3);
  wire << 3, 4;
  F << 0, 1, 2, 5, 6, 7;
  const Eigen::MatrixXi E = complete_edges(wire, F);
  const StartReport pierced = check(Mesh(x, E, F), x);
  CHECK((pierced.intersections.size() == 1 && pierced.touching.empty() &&
         pierced.faces_without_area == std::vector<int>{1}));
  CHECK(says(pierced, StartFault::intersecting,
             "edge 0 (vertices 3 and 4) and face 0 (vertices 0, 1 and 2), crossing"));
  CHECK(says(pierced, StartFault::intersecting, "rules.excluded_intersections = report.intersections"));
  CHECK(says(pierced, StartFault::faces_without_area, "first face 1 (vertices 5, 6 and 7)"));
  CHECK((pierced.findings.size() == 2 && !pierced.acceptable() && !pierced.clean()));
  Mesh accepted(x, E, F);
  set_rule(accepted, &CollisionRules::excluded_intersections, pierced.intersections);
  CHECK((check(accepted, x).intersections.empty() && !has_intersections(accepted, x)));

  Mesh loose(x, Eigen::MatrixXi(wire), Eigen::MatrixXi(0, 3));
  const StartReport unused = check(loose, x);
  CHECK(unused.unused_vertices == std::vector<int>{0, 1, 2, 5, 6, 7});
  CHECK(says(unused, StartFault::unused_vertices, "rules.points = report.unused_vertices"));
  CHECK((unused.acceptable() && !unused.clean()));
  set_rule(loose, &CollisionRules::points, unused.unused_vertices);
  CHECK(check(loose, x).clean());
}

TEST_CASE("pairs that are found can be left out, by every call", "[property]") {
  Random random(93);
  for (int round = 0; round < 6; ++round) {
    Crowd crowd = grid_crowd(16, 3, random);
    Options o;
    o.min_separation = 0.25;
    const StartReport report = check(crowd.mesh, crowd.x, o);
    REQUIRE((!report.touching.empty() && !report.within_separation.empty()));
    CHECK(says(report, StartFault::touching, "rules.excluded_pairs = report.touching"));
    CHECK(says(report, StartFault::within_separation, "Options::min_separation"));
    const FilterCounts before = crowd.mesh.filter_counts();
    set_rule(crowd.mesh, &CollisionRules::excluded_pairs, report.touching);
    StartReport rest = check(crowd.mesh, crowd.x, o);
    CHECK((rest.touching.empty() && rest.within_separation.size() == report.within_separation.size()));
    const FilterCounts& plan = crowd.mesh.filter_counts();
    CHECK(plan.vertex_face.excluded + plan.edge_edge.excluded == std::int64_t(report.touching.size()));
    CHECK(plan.vertex_face.may_meet() + plan.edge_edge.may_meet() ==
          before.vertex_face.may_meet() + before.edge_edge.may_meet() - std::int64_t(report.touching.size()));
    std::vector<Pair> all(report.within_separation.begin(), report.within_separation.end());
    all.insert(all.end(), report.touching.rbegin(), report.touching.rend());
    set_rule(crowd.mesh, &CollisionRules::excluded_pairs, all);
    rest = check(crowd.mesh, crowd.x, o);
    CHECK((rest.touching.empty() && rest.within_separation.empty()));
    CHECK(compute_collision_free_stepsize(crowd.mesh, crowd.x, crowd.x, o).outcome == Outcome::free);
    CHECK(construct_active_set(crowd.mesh, crowd.x, crowd.x, o).size() == 0);
    for (const ClosePair& p : close_pairs(crowd.mesh, crowd.x, 0.5, o))
      for (const Pair& q : all) CHECK_FALSE((p.kind == q.kind && p.a == q.a && p.b == q.b));
    set_rule(crowd.mesh, &CollisionRules::excluded_pairs,
             {report.within_separation.begin(), report.within_separation.end()});
    CHECK(check(crowd.mesh, crowd.x, o).touching.size() == report.touching.size());
  }
}

TEST_CASE("a start within its separation is not acceptable, though nothing touches", "[unit]") {
  Eigen::MatrixXd x(6, 3);
  x << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0.5, 1, 0, 0.5, 0, 1, 0.5;
  const Mesh mesh(x, Eigen::MatrixXi((Eigen::MatrixXi(2, 3) << 0, 1, 2, 3, 4, 5).finished()));
  Options o;
  CHECK(check(mesh, x, o).clean());
  o.min_separation = 0.75;
  const StartReport near = check(mesh, x, o);
  CHECK((near.outcome == Outcome::free && near.intersections.empty() && near.touching.empty()));
  CHECK((!near.within_separation.empty() && !near.acceptable()));
}

TEST_CASE("among many vertices only those at one place are copies", "[unit]") {
  // So many places have some numbers twice that sort them, whichever axis tells them apart.
  constexpr int kCount = 250000;
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(kCount, 3);
  for (int axis = 0; axis < 3; ++axis) {
    CAPTURE(axis);
    x.setZero();
    x.col(axis) = Eigen::VectorXd::LinSpaced(kCount, 1, kCount);
    CHECK(duplicate_vertices(x).empty());
    x(kCount - 1, axis) = 7;
    CHECK((duplicate_vertices(x) == std::vector<std::array<int, 2>>{{6, kCount - 1}}));
  }
  CHECK_THROWS_WITH(duplicate_vertices(x.leftCols(1)), "x has 1 columns, not 2 or 3");

  // It can be stopped wherever it asks, in every round over the vertices.
  x.bottomRows(kCount / 2) = x.topRows(kCount / 2);
  tests::Asks all;
  REQUIRE(shared_places(x, all.stop()).size() == kCount / 2);
  CHECK(all.count >= 5 * (kCount / std::int64_t(kItemsALook)));
  for (std::int64_t n = 0; n < all.count; n += 1 + n / 8) {
    tests::Asks some(n);
    CHECK(shared_places(x, some.stop()).empty());
    CHECK(some.count == n + 1);
  }
}

TEST_CASE("points are named as the vertices that they are", "[unit]") {
  Eigen::MatrixXd x(6, 3);
  x << 0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, 0, 3, 0, 0, 9, 9, 9;
  const Eigen::MatrixXi F = (Eigen::MatrixXi(1, 3) << 0, 1, 2).finished();
  Mesh mesh(x, F);
  set_rule(mesh, &CollisionRules::points, {3, 4, 5});
  const StartReport report = check(mesh, x);
  CHECK(says(report, StartFault::touching, "vertex 3 and face 0 (vertices 0, 1 and 2)"));
  x(3, 2) = 1;  // now only the one on the edge touches
  x(4, 2) = 0;
  CHECK(says(check(mesh, x), StartFault::touching, "vertex 4"));
}

TEST_CASE("a start that cannot be looked at, or not to the end, is not acceptable", "[unit]") {
  const Crowd crowd = apart_crowd();
  CHECK(check(crowd.mesh, crowd.x).clean());
  Eigen::MatrixXd x = crowd.x;
  x(7, 2) = NAN;
  const StartReport bad = check(crowd.mesh, x);
  CHECK((bad.outcome == Outcome::non_finite && bad.vertex == 7 && !bad.acceptable() && !bad.clean()));
  Options o;
  o.time_limit = 0;
  CHECK((check(crowd.mesh, crowd.x, o).outcome == Outcome::out_of_time &&
         !check(crowd.mesh, crowd.x, o).acceptable()));
  o = {};
  o.progress = [](double) { return false; };
  CHECK(check(crowd.mesh, crowd.x, o).outcome == Outcome::cancelled);
  const Seam seam;
  o = {};
  o.memory_limit = 16;
  const StartReport cut = check(Mesh(seam.x, seam.F), seam.x, o);
  CHECK((cut.outcome == Outcome::out_of_memory && cut.intersections.empty() && cut.touching.empty()));
  CHECK(cut.copied_vertices.size() == 2);
  o.min_separation = -1;
  CHECK_THROWS_AS(check(crowd.mesh, crowd.x, o), std::invalid_argument);
  CHECK_THROWS_AS(check(crowd.mesh, crowd.x.topRows(3)), std::invalid_argument);
}
