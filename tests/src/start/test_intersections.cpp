// The list of edges through faces against every pair in exact arithmetic, under every rule, method and
// budget.
#include <tbb/global_control.h>

#include <algorithm>
#include <onset/onset.hpp>

#include "base/instruction_set.hpp"
#include "tests/catch.hpp"
#include "tests/oracle/promises.hpp"
#include "tests/scenes/rules.hpp"
#include "tests/src/start/brute_intersections.hpp"
#include "tests/src/support/crowds.hpp"

using namespace onset;
using namespace onset::tests;
using scenes::change_rules;
using scenes::Random;
using scenes::set_rule;

namespace {

// Four threads even where there are fewer cores.
const tbb::global_control four_workers(tbb::global_control::max_allowed_parallelism, 4);

bool same(const Intersections& a, const Intersections& b) {
  return a.outcome == b.outcome && a.vertex == b.vertex && plain(a.pairs) == plain(b.pairs) &&
         std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Intersection& p, const Intersection& q) { return p.vertices == q.vertices; });
}

std::vector<Options> all_ways() {
  std::vector<Options> ways;
  for (const BroadPhaseMethod method :
       {BroadPhaseMethod::bvh, BroadPhaseMethod::hash, BroadPhaseMethod::brute})
    for (const InstructionSet kernel : {InstructionSet::scalar, InstructionSet::avx2})
      for (const int threads : {1, 2, 4}) {
        if (kernel == InstructionSet::avx2 && !has_avx2()) continue;
        Options o;
        o.broad_phase = method, o.instruction_set = kernel, o.threads = threads;
        ways.push_back(o);
      }
  return ways;
}

void check_all_ways(const Mesh& mesh, const Eigen::MatrixXd& x, const std::vector<Found>& expected) {
  const Intersections first = intersections(mesh, x);
  REQUIRE((plain(first.pairs) == expected));
  CHECK(first.outcome == Outcome::free);
  for (const Options& o : all_ways()) {
    CHECK(same(intersections(mesh, x, o), first));
    CHECK(has_intersections(mesh, x, o) == !expected.empty());
  }
}

}  // namespace

TEST_CASE("intersections are those of all edges and faces, by any method and any number of threads",
          "[oracle][property]") {
  Random random(80 + oracle::fuzz_seed());
  std::size_t counts[3] = {}, none = 0;
  for (int round = 0; round < std::max(6, oracle::fuzz(24)); ++round) {
    const Crowd crowd = some_crowd(round, random);
    INFO(crowd.name << ", round " << round);
    const std::vector<Found> expected = brute_intersections(crowd.mesh, crowd.x);
    check_all_ways(crowd.mesh, crowd.x, expected);
    for (const Found& p : expected) ++counts[std::size_t(p.kind)];
    none += expected.empty();
  }
  for (const std::size_t n : counts) CHECK(n > 10);
  CHECK(none > 0);
}

TEST_CASE("an intersection names its vertices, and its kind by one of three words", "[unit]") {
  Eigen::MatrixXd x(7, 3);
  x << 0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, -1, 1, 1, 1, 2, 2, 0, 9, 9, 9;
  Eigen::MatrixXi wire(1, 2), F(1, 3);
  wire << 3, 4;
  F << 0, 1, 2;
  Mesh mesh(7, complete_edges(wire, F), F);
  const Intersections without = intersections(mesh, x);
  REQUIRE(without.size() == 1);
  CHECK((without.begin()->edge == 0 && without.begin()->face == 0));
  CHECK(without.begin()->vertices == std::array<int, 5>{3, 4, 0, 1, 2});
  CHECK(without.count(IntersectionKind::crossing) == 1);
  set_rule(mesh, &CollisionRules::points, {6, 5});
  const Intersections with = intersections(mesh, x);
  REQUIRE(with.size() == 2);
  CHECK((with.pairs[1].edge == 5 && with.pairs[1].kind == IntersectionKind::touching));
  CHECK(with.pairs[1].vertices == std::array<int, 5>{5, 5, 0, 1, 2});
  CHECK(std::string(to_string(IntersectionKind::crossing)) == "crossing");
  CHECK(std::string(to_string(IntersectionKind::touching)) == "touching");
  CHECK(std::string(to_string(IntersectionKind::overlapping)) == "overlapping");
}

TEST_CASE("intersections keep to the rules of the mesh", "[oracle][property]") {
  Random random(81 + oracle::fuzz_seed());
  std::size_t left = 0, kept = 0;
  for (int round = 0; round < std::max(6, oracle::fuzz(12)); ++round) {
    const Crowd crowd = some_crowd(round, random);
    const std::vector<Found> all = brute_intersections(crowd.mesh, crowd.x);
    const std::vector<int> body = crowd.mesh.components();
    const auto check = [&](const Mesh& mesh, auto&& lets) {
      std::vector<Found> expected;
      for (const Found& p : all)
        if (lets(p.edge, p.face)) expected.push_back(p);
      CHECK((plain(intersections(mesh, crowd.x).pairs) == expected));
      CHECK(has_intersections(mesh, crowd.x) == !expected.empty());
      kept += expected.size(), left += all.size() - expected.size();
    };
    const auto body_of_edge = [&](int e) { return body[std::size_t(crowd.mesh.edge(e)[0])]; };
    const auto body_of_face = [&](int f) { return body[std::size_t(crowd.mesh.face(f)[0])]; };
    Mesh mesh = crowd.mesh;
    set_rule(mesh, &CollisionRules::bodies, body);
    std::vector<bool> odd(std::size_t(mesh.num_bodies()));
    for (std::size_t b = 1; b < odd.size(); b += 2) odd[b] = true;
    set_rule(mesh, &CollisionRules::static_vertices, mesh.of_bodies(odd));
    check(mesh, [&](int e, int f) {
      return !odd[std::size_t(body_of_edge(e))] || !odd[std::size_t(body_of_face(f))];
    });
    mesh = crowd.mesh;
    change_rules(mesh, [&](CollisionRules& r) { r.rigid_bodies = odd, r.bodies = body; });
    check(mesh, [&](int e, int f) {
      return body_of_edge(e) != body_of_face(f) || !odd[std::size_t(body_of_edge(e))];
    });
    if (mesh.num_bodies() > 1) {
      mesh = crowd.mesh;
      change_rules(mesh, [&](CollisionRules& r) { r.excluded_bodies = {{0, 1}}, r.bodies = body; });
      check(mesh, [&](int e, int f) {
        return body_of_edge(e) + body_of_face(f) != 1 || body_of_edge(e) == body_of_face(f);
      });
    }
    std::vector<Intersection> named;
    for (std::size_t i = 0; i < all.size(); i += 2)
      named.push_back({all[i].edge, all[i].face, all[i].kind, {}});
    mesh = crowd.mesh;
    set_rule(mesh, &CollisionRules::excluded_intersections, named);
    std::size_t i = 0;
    check(mesh, [&](int, int) { return i++ % 2 == 1; });
  }
  CHECK((left > 50 && kept > 50));
}

// The face's three corners have what lets it meet the edge one each, so that no two of them do.
TEST_CASE("an edge may meet a face and neither its edges nor its vertices", "[unit]") {
  Eigen::MatrixXd x(5, 3);
  x << 0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, -1, 1, 1, 1;
  const Eigen::MatrixXi wire = Eigen::RowVector2i(3, 4), F = Eigen::RowVector3i(0, 1, 2);
  Mesh mesh(5, complete_edges(wire, F), F);
  CollisionRules rules;
  rules.groups = {1, 0, 0, 1, 0}, rules.masks = {0, 1, 0, 0, 1};
  rules.static_vertices = {true, true, false, true, true};
  mesh.set_rules(rules);
  CHECK((mesh.filter_counts().edge_edge.may_meet() == 0 && mesh.filter_counts().vertex_face.may_meet() == 0));
  for (const Options& o : all_ways()) {
    CHECK(intersections(mesh, x, o).count(IntersectionKind::crossing) == 1);
    CHECK(has_intersections(mesh, x, o));
  }
}

TEST_CASE("with welds, vertices at one place count as one", "[oracle][property]") {
  Random random(82 + oracle::fuzz_seed());
  std::size_t left = 0, kept = 0;
  for (int round = 0; round < std::max(6, oracle::fuzz(12)); ++round) {
    const Crowd crowd = some_crowd(round, random);
    Mesh welded = crowd.mesh, named = crowd.mesh;
    set_rule(welded, &CollisionRules::weld, true);
    set_rule(named, &CollisionRules::excluded_vertices, duplicate_vertices(crowd.x));
    const std::vector<Found> expected = brute_intersections(crowd.mesh, crowd.x, [&](int e, int f) {
      for (const int v : crowd.mesh.edge(e))
        for (const int w : crowd.mesh.face(f))
          if (crowd.x.row(v) == crowd.x.row(w)) return ++left, false;
      return true;
    });
    kept += expected.size();
    CHECK((plain(intersections(welded, crowd.x).pairs) == expected));
    CHECK(has_intersections(welded, crowd.x) == !expected.empty());
    CHECK((plain(intersections(named, crowd.x).pairs) == expected));
  }
  CHECK((left > 50 && kept > 50));
}

TEST_CASE("what cannot be looked at is an outcome, and counts as intersecting", "[unit]") {
  const Crowd crowd = apart_crowd();
  REQUIRE_FALSE(has_intersections(crowd.mesh, crowd.x));
  for (const double bad : {double(NAN), double(INFINITY), -0x1p1021}) {
    Eigen::MatrixXd x = crowd.x;
    x(5, 1) = bad;
    const Intersections r = intersections(crowd.mesh, x);
    CHECK(r.outcome == (std::isfinite(bad) ? Outcome::out_of_range : Outcome::non_finite));
    CHECK((r.vertex == 5 && r.empty()));
    CHECK(has_intersections(crowd.mesh, x));
  }
  CHECK_THROWS_AS(intersections(crowd.mesh, crowd.x.topRows(4)), std::invalid_argument);
  Options o;
  o.threads = -1;
  CHECK_THROWS_AS(has_intersections(crowd.mesh, crowd.x, o), std::invalid_argument);
}

TEST_CASE("the largest and the smallest coordinates are looked at", "[unit]") {
  Random random(83);
  for (int round = 0; round < 6; ++round) {
    const Crowd crowd = grid_crowd(12, 3, random);
    const std::vector<Found> expected = brute_intersections(crowd.mesh, crowd.x);
    for (const int exponent : {1018, 300, -300, -1074}) {
      Eigen::MatrixXd x = crowd.x;
      for (Eigen::Index i = 0; i < x.size(); ++i) x.data()[i] = std::ldexp(x.data()[i], exponent);
      CHECK((plain(intersections(crowd.mesh, x).pairs) == expected));
      x.col(1) = crowd.x.col(1);
      CHECK((plain(intersections(crowd.mesh, x).pairs) == expected));
    }
  }
}

TEST_CASE("budgets end the search with an outcome of their own", "[unit]") {
  Random random(84);
  const Crowd crowd = grid_crowd(40, 3, random);
  const Intersections all = intersections(crowd.mesh, crowd.x);
  REQUIRE(all.size() > 10);
  Options o;
  o.time_limit = 0;
  CHECK(intersections(crowd.mesh, crowd.x, o).outcome == Outcome::out_of_time);
  CHECK(has_intersections(crowd.mesh, crowd.x, o));
  o = {};
  for (const int threads : {1, 4}) {
    o.threads = threads;
    o.memory_limit = std::int64_t(all.size() * sizeof(Intersection));
    CHECK(same(intersections(crowd.mesh, crowd.x, o), all));
    o.memory_limit -= 1;
    const Intersections cut = intersections(crowd.mesh, crowd.x, o);
    CHECK((cut.outcome == Outcome::out_of_memory && cut.empty()));
  }
  o = {};
  std::vector<double> reported;
  o.progress = [&](double share) { return reported.push_back(share), true; };
  CHECK(same(intersections(crowd.mesh, crowd.x, o), all));
  REQUIRE(!reported.empty());
  CHECK((reported.front() == 0 && reported.back() <= 1));
  o.progress = [](double) { return false; };
  CHECK(intersections(crowd.mesh, crowd.x, o).outcome == Outcome::cancelled);
  CHECK(has_intersections(crowd.mesh, crowd.x, o));
}
