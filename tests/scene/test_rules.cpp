// The rules of a mesh: checked at once, whole or not at all, in any order, and given back as they were set.
#include <algorithm>
#include <onset/onset.hpp>
#include <stdexcept>

#include "tests/catch.hpp"
#include "tests/scenes/meshes.hpp"
#include "tests/scenes/rules.hpp"
#include "tests/src/support/scene_set.hpp"

using namespace onset;
using Catch::Contains;
using scenes::change_rules;
using scenes::Scene;
using scenes::set_rule;
using tests::same_bytes;

namespace {

const Eigen::MatrixXi kNoFaces(0, 3);

// Two cubes, far apart: vertices 0 to 7 and 8 to 15.
Mesh two_cubes() {
  const Scene scene = scenes::joined(scenes::cube(), scenes::translated(scenes::cube(), {3, 0, 0}));
  return Mesh(scene.x_t0, scene.faces);
}

bool same_pairs(const std::vector<Pair>& a, const std::vector<Pair>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Pair& p, const Pair& q) {
    return p.kind == q.kind && p.a == q.a && p.b == q.b && p.vertices == q.vertices;
  });
}
bool same_intersections(const std::vector<Intersection>& a, const std::vector<Intersection>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Intersection& p, const Intersection& q) {
    return p.edge == q.edge && p.face == q.face && p.kind == q.kind && p.vertices == q.vertices;
  });
}
bool same_positions(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() && a == b;
}
bool same_rules(const CollisionRules& a, const CollisionRules& b) {
  return a.points == b.points && a.thickness == b.thickness && a.bodies == b.bodies &&
         a.rigid_bodies == b.rigid_bodies &&
         a.bodies_without_self_collision == b.bodies_without_self_collision &&
         a.excluded_bodies == b.excluded_bodies && a.static_vertices == b.static_vertices &&
         a.groups == b.groups && a.masks == b.masks && a.weld == b.weld &&
         a.excluded_vertices == b.excluded_vertices && same_pairs(a.excluded_pairs, b.excluded_pairs) &&
         same_intersections(a.excluded_intersections, b.excluded_intersections) &&
         a.excluded_rings == b.excluded_rings && a.rest_share == b.rest_share &&
         same_positions(a.rest_positions, b.rest_positions) &&
         std::equal(a.body_separations.begin(), a.body_separations.end(), b.body_separations.begin(),
                    b.body_separations.end(), [](const BodySeparation& s, const BodySeparation& t) {
                      return s.body_a == t.body_a && s.body_b == t.body_b && s.separation == t.separation;
                    });
}

// Two falling cubes, three points beside them, and something in every rule.
struct Everything {
  Scene scene;
  CollisionRules rules;
  Everything() {
    Scene upper = scenes::translated(scenes::cube(), {0.25, 0.25, 2.25});
    scenes::displace(upper, {0, 0, -1});
    scene = scenes::joined(scenes::cube(), upper);
    scene.x_t0.conservativeResize(19, 3), scene.x_t1.conservativeResize(19, 3);
    scene.x_t0.bottomRows(3) << 0, 0, 4, 0.5, 0.5, 5, 1, 1, 6;
    scene.x_t1.bottomRows(3) << 0, 0, 0, 0.5, 0.5, 0, 1, 1, 0;
    rules.points = {18, 16, 17};
    rules.thickness.assign(19, 0.01);
    rules.bodies.assign(19, 0);
    for (std::size_t v = 8; v < 19; ++v) rules.bodies[v] = v < 16 ? 1 : 2;
    rules.rigid_bodies = {true, false, false}, rules.bodies_without_self_collision = {false, true, false};
    rules.excluded_bodies = {{2, 1}};
    rules.static_vertices.assign(19, false);
    for (std::size_t v = 0; v < 8; ++v) rules.static_vertices[v] = true;
    rules.groups.assign(19, 1), rules.masks.assign(19, 1);
    rules.groups[9] = 2;
    rules.weld = true;
    rules.excluded_vertices = {{16, 3}};
    rules.excluded_pairs = {{PairKind::vertex_face, 8, 0, {}}, {PairKind::edge_edge, 37, 36, {}}};
    rules.body_separations = {{1, 0, 0.02}, {2, 2, 0.5}};
    rules.rest_positions = scene.x_t0, rules.rest_share = 0.25;
    rules.excluded_rings = 1;
    rules.excluded_intersections = {{36, 1, IntersectionKind::touching, {}}};
  }
  Mesh mesh(const CollisionRules& r = {}) const { return Mesh(scene.x_t0, scene.faces, r); }
  ActiveSet ask(const Mesh& mesh) const { return construct_active_set(mesh, scene.x_t0, scene.x_t1); }
};

}  // namespace

TEST_CASE("a mesh gives back the rules that it was made with, or that were set", "[unit]") {
  const Everything all;
  CHECK(same_rules(all.mesh().rules(), CollisionRules()));
  const Mesh made = all.mesh(all.rules);
  CHECK(same_rules(made.rules(), all.rules));
  Mesh mesh = all.mesh();
  const Mesh copy = mesh;
  mesh.set_rules(all.rules);
  CHECK(same_rules(mesh.rules(), all.rules));
  CHECK(same_rules(copy.rules(), CollisionRules()));
  CHECK((mesh.num_points() == 3 && copy.num_points() == 0));
  REQUIRE(all.ask(made).size() > 0);
  CHECK(same_bytes(all.ask(mesh), all.ask(made)));
  CHECK_FALSE(same_bytes(all.ask(mesh), all.ask(copy)));
  mesh.set_rules(mesh.rules());  // themselves
  CHECK(same_rules(mesh.rules(), all.rules));
  mesh.set_rules({});
  CHECK(same_bytes(all.ask(mesh), all.ask(copy)));
  CHECK((mesh.num_bodies() == 1 && mesh.num_edges() == copy.num_edges()));
  CHECK(same_rules(Mesh(19, edges(all.scene.faces), all.scene.faces, all.rules).rules(), all.rules));
}

TEST_CASE("rules may be filled in any order, at once or one by one", "[unit]") {
  const Everything all;
  const CollisionRules& r = all.rules;
  Mesh mesh = all.mesh();
  // What another rule is counted by is set before it; all else the other way around.
  set_rule(mesh, &CollisionRules::weld, r.weld);
  set_rule(mesh, &CollisionRules::excluded_vertices, r.excluded_vertices);
  change_rules(mesh, [&](CollisionRules& rules) { rules.masks = r.masks, rules.groups = r.groups; });
  set_rule(mesh, &CollisionRules::static_vertices, r.static_vertices);
  set_rule(mesh, &CollisionRules::bodies, r.bodies);
  set_rule(mesh, &CollisionRules::excluded_bodies, r.excluded_bodies);
  set_rule(mesh, &CollisionRules::bodies_without_self_collision, r.bodies_without_self_collision);
  set_rule(mesh, &CollisionRules::rigid_bodies, r.rigid_bodies);
  set_rule(mesh, &CollisionRules::thickness, r.thickness);
  set_rule(mesh, &CollisionRules::excluded_rings, r.excluded_rings);
  set_rule(mesh, &CollisionRules::rest_share, r.rest_share);
  set_rule(mesh, &CollisionRules::rest_positions, r.rest_positions);
  set_rule(mesh, &CollisionRules::body_separations, r.body_separations);
  set_rule(mesh, &CollisionRules::points, r.points);
  set_rule(mesh, &CollisionRules::excluded_intersections, r.excluded_intersections);
  set_rule(mesh, &CollisionRules::excluded_pairs, r.excluded_pairs);
  CHECK(same_rules(mesh.rules(), r));
  const Mesh at_once = all.mesh(r);
  CHECK(same_bytes(all.ask(mesh), all.ask(at_once)));
  CHECK(mesh.filter_counts().edge_edge.may_meet() == at_once.filter_counts().edge_edge.may_meet());
  CHECK(mesh.filter_counts().vertex_face.may_meet() == at_once.filter_counts().vertex_face.may_meet());

  // Dependent fields filled first, in one set of rules.
  CollisionRules backwards;
  backwards.excluded_pairs = r.excluded_pairs, backwards.rigid_bodies = r.rigid_bodies;
  backwards.excluded_bodies = r.excluded_bodies, backwards.points = r.points, backwards.bodies = r.bodies;
  CHECK_NOTHROW(all.mesh(backwards));
}

TEST_CASE("a static vertex that moves is refused by every call that takes two ends of a motion", "[unit]") {
  Mesh mesh = two_cubes();
  Eigen::MatrixXd x = Eigen::MatrixXd::Random(16, 3), there = x;
  const Candidates listed = compute_candidates(mesh, x, x);
  const ClosePairs close = close_pairs(mesh, x, 0.1);
  std::vector<bool> still(16);
  still[11] = true;
  set_rule(mesh, &CollisionRules::static_vertices, still);
  const auto refused = [](const auto& call) { CHECK_THROWS_WITH(call(), Contains("vertex 11 is static")); };
  there(11, 1) += 0x1p-50;
  refused([&] { compute_collision_free_stepsize(mesh, x, there); });
  refused([&] { is_step_collision_free(mesh, x, there); });
  refused([&] { construct_active_set(mesh, x, there); });
  refused([&] { compute_candidates(mesh, x, there); });
  refused([&] { LineSearch(mesh, x, Eigen::MatrixXd(there - x)); });
  refused([&] { compute_collision_free_stepsize(mesh, listed, x, there); });
  refused([&] { compute_cfl_stepsize(mesh, x, there, close); });
}

TEST_CASE("wrong rules name what is wrong and leave the mesh as it was", "[unit]") {
  Mesh mesh = two_cubes();
  std::vector<int> body(16, 0);
  body[15] = 1;
  CHECK_THROWS_WITH(set_rule(mesh, &CollisionRules::bodies, body),
                    Contains("edge row") && Contains("vertex 15 in body 1"));
  body[15] = -1;
  CHECK_THROWS_WITH(set_rule(mesh, &CollisionRules::bodies, body), Contains("bodies row 15"));
  CHECK_THROWS_WITH(set_rule(mesh, &CollisionRules::bodies, {0, 1}),
                    Contains("bodies has 2 values for 16 vertices"));
  CHECK(mesh.num_bodies() == 1);
  CHECK(same_rules(mesh.rules(), CollisionRules()));
  set_rule(mesh, &CollisionRules::bodies, mesh.components());
  REQUIRE(mesh.num_bodies() == 2);
  CHECK(mesh.body(7) == 0);
  CHECK(mesh.body(8) == 1);
  const CollisionRules before = mesh.rules();
  CHECK_THROWS_WITH(set_rule(mesh, &CollisionRules::static_vertices, {true}),
                    Contains("static_vertices has 1 values for 16 vertices"));
  CHECK_THROWS_WITH(set_rule(mesh, &CollisionRules::rigid_bodies, {true}),
                    Contains("rigid_bodies has 1 values for 2 bodies"));
  CHECK_THROWS_WITH(set_rule(mesh, &CollisionRules::bodies_without_self_collision, {true}),
                    Contains("bodies_without_self_collision has 1 values for 2 bodies"));
  for (const std::size_t groups : {0u, 1u, 16u})
    for (const std::size_t masks : {0u, 1u, 16u}) {
      if (groups == masks && groups != 1) continue;  // both or none
      const auto set = [&] {
        change_rules(mesh, [&](CollisionRules& r) { r.groups.resize(groups), r.masks.resize(masks); });
      };
      CHECK_THROWS_WITH(
          set(), Contains(groups != 16 ? "groups has" : "masks has") && Contains("values for 16 vertices"));
    }
  CHECK_THROWS_WITH(set_rule(mesh, &CollisionRules::excluded_bodies, {{0, 1}, {1, 2}}),
                    Contains("excluded_bodies row 1") && Contains("id 2"));
  CHECK_THROWS_WITH(set_rule(mesh, &CollisionRules::excluded_vertices, {{3, 3}}),
                    Contains("excluded_vertices row 0") && Contains("repeated"));
  CHECK(same_rules(mesh.rules(), before));
  CHECK(mesh.filter_counts().vertex_face.same_body == 0);
  CHECK(mesh.filter_counts().vertex_face.excluded == 0);
  CHECK_THROWS_WITH(Mesh(16, kNoFaces,
                         [] {
                           CollisionRules r;
                           r.points = {3, 16};
                           return r;
                         }()),
                    Contains("points row 1: vertex 16 is out of range"));
}

TEST_CASE("one wrong rule among many changes nothing of a mesh that has others", "[unit]") {
  const Everything all;
  for (int wrong = 0; wrong < 12; ++wrong) {
    Mesh mesh = all.mesh(all.rules);
    mesh.set_full_vertices({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 20}, 30);
    const ActiveSet before = all.ask(mesh);
    CollisionRules rules;  // all others as they are in a new mesh, so that each would show
    if (wrong == 0) rules.points = {0};
    if (wrong == 1) rules.thickness = {-1};
    if (wrong == 2) rules.bodies = {0};
    if (wrong == 3) rules.rigid_bodies = {true, true};
    if (wrong == 4) rules.static_vertices = {true};
    if (wrong == 5) rules.masks = {1};
    if (wrong == 6) rules.excluded_pairs = {{PairKind::edge_edge, 36, 37, {}}};  // no points any more
    if (wrong == 7) rules.excluded_intersections = {{0, 24, IntersectionKind::crossing, {}}};
    if (wrong == 8) rules.excluded_rings = -1;
    if (wrong == 9) rules.body_separations = {{0, 0, -1}};
    if (wrong == 10) rules.rest_positions = Eigen::MatrixXd::Zero(3, 3);
    if (wrong == 11) rules.rest_share = 1;
    CAPTURE(wrong);
    CHECK_THROWS_AS(mesh.set_rules(rules), std::invalid_argument);
    CHECK(same_rules(mesh.rules(), all.rules));
    CHECK((mesh.num_points() == 3 && mesh.num_bodies() == 3 && mesh.full_vertex(18) == 20));
    CHECK(same_bytes(all.ask(mesh), before));
  }
}

TEST_CASE("flags and pairs of bodies that there are not any more are an error that names them", "[unit]") {
  Mesh mesh = two_cubes();
  change_rules(mesh, [&](CollisionRules& r) {
    r.bodies = mesh.components();
    r.rigid_bodies = {true, false}, r.excluded_bodies = {{0, 1}};
  });
  const std::int64_t meet = mesh.filter_counts().edge_edge.may_meet();
  CHECK_THROWS_WITH(set_rule(mesh, &CollisionRules::bodies, {}),
                    Contains("rigid_bodies has 2 values for 1 bodies"));
  std::vector<int> more(16, 0);
  std::fill(more.begin() + 8, more.end(), 2);
  CHECK_THROWS_WITH(set_rule(mesh, &CollisionRules::bodies, more),
                    Contains("rigid_bodies has 2 values for 3 bodies"));
  CHECK_THROWS_WITH(change_rules(mesh, [](CollisionRules& r) { r.bodies = {}, r.rigid_bodies = {}; }),
                    Contains("excluded_bodies row 0: id 1 is out of range, there are 1"));
  CHECK((mesh.num_bodies() == 2 && mesh.filter_counts().edge_edge.may_meet() == meet));
  change_rules(mesh, [&](CollisionRules& r) { r.bodies = more, r.rigid_bodies = {true, false, false}; });
  CHECK((mesh.num_bodies() == 3 && mesh.rules().excluded_bodies.size() == 1));
}

TEST_CASE("pairs to leave out are named by row where they are none", "[unit]") {
  Mesh mesh = two_cubes();
  const Pair good{PairKind::vertex_face, 15, 0, {}};
  const auto with = [&](const Pair& bad) { set_rule(mesh, &CollisionRules::excluded_pairs, {good, bad}); };
  CHECK_THROWS_WITH(with({PairKind::vertex_face, 16, 0, {}}),
                    Contains("excluded_pairs row 1: vertex 16 is out of range, there are 16 vertices"));
  CHECK_THROWS_WITH(with({PairKind::vertex_face, 0, 24, {}}), Contains("row 1: face 24"));
  CHECK_THROWS_WITH(with({PairKind::edge_edge, -1, 3, {}}), Contains("row 1: edge -1"));
  CHECK_THROWS_WITH(with({PairKind::edge_edge, 3, 3, {}}), Contains("row 1: edge 3 is repeated"));
  for (const int kind : {2, 9})
    CHECK_THROWS_WITH(with({PairKind(kind), 3, 4, {}}),
                      Contains("row 1") && Contains("kind " + std::to_string(kind)));
  CHECK_THROWS_WITH(
      set_rule(mesh, &CollisionRules::excluded_intersections, {{0, 24, IntersectionKind::crossing, {}}}),
      Contains("excluded_intersections row 0: face 24"));
  CHECK(mesh.filter_counts().vertex_face.excluded == 0);
  set_rule(mesh, &CollisionRules::excluded_pairs, {good, {PairKind::edge_edge, 30, 2, {}}, good});
  CHECK((mesh.filter_counts().vertex_face.excluded == 1 && mesh.filter_counts().edge_edge.excluded == 1));
  set_rule(mesh, &CollisionRules::excluded_vertices, {{15, mesh.face(0)[0]}});  // the same pair, counted once
  CHECK(mesh.filter_counts().vertex_face.excluded > 1);
  const std::int64_t both = mesh.filter_counts().vertex_face.excluded;
  set_rule(mesh, &CollisionRules::excluded_pairs, {});
  CHECK(mesh.filter_counts().vertex_face.excluded == both);
}

TEST_CASE("pairs of points that there are not any more are an error that names them", "[unit]") {
  Mesh mesh(9, Eigen::MatrixXi((Eigen::MatrixXi(1, 3) << 0, 1, 2).finished()));
  change_rules(mesh, [](CollisionRules& r) {
    r.excluded_pairs = {
        {PairKind::edge_edge, 3, 4, {}}, {PairKind::vertex_face, 7, 0, {}}, {PairKind::edge_edge, 0, 3, {}}};
    r.excluded_intersections = {{4, 0, IntersectionKind::touching, {}}};
    r.points = {3, 4, 5};
  });
  const auto counts = [&] { return std::array{mesh.filter_counts().edge_edge.excluded, mesh.num_edges()}; };
  CHECK((mesh.filter_counts().edge_edge.excluded == 2 && mesh.filter_counts().vertex_face.excluded == 1));
  const auto before = counts();
  CHECK_THROWS_WITH(set_rule(mesh, &CollisionRules::points, {}), Contains("excluded_pairs row 0: edge 3"));
  CHECK_THROWS_WITH(set_rule(mesh, &CollisionRules::points, {6}), Contains("excluded_pairs row 0: edge 4"));
  CHECK_THROWS_WITH(change_rules(mesh, [](CollisionRules& r) { r.points = {6}, r.excluded_pairs = {}; }),
                    Contains("excluded_intersections row 0: edge 4"));
  CHECK(counts() == before);
  // Others in their place have their ids, and so their pairs.
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(9, 3);
  x.row(1) << 1, 0, 0, x.row(2) << 0, 1, 0;
  CHECK(intersections(mesh, x).size() == 2);
  set_rule(mesh, &CollisionRules::points, {6, 7, 8});
  CHECK(counts() == before);
  REQUIRE(intersections(mesh, x).size() == 2);
  CHECK(intersections(mesh, x).pairs[1].vertices[0] == 8);
  change_rules(mesh, [](CollisionRules& r) { r.excluded_pairs.clear(), r.excluded_intersections.clear(); });
  CHECK((mesh.filter_counts().edge_edge.excluded == 0 && mesh.filter_counts().vertex_face.excluded == 0));
  CHECK(intersections(mesh, x).size() == 3);
}

TEST_CASE("wrong separations of bodies, shapes at rest and rings are errors that name the row", "[unit]") {
  Mesh mesh = two_cubes();
  set_rule(mesh, &CollisionRules::bodies, mesh.components());
  const auto bodies = [&](const BodySeparation& s) {
    set_rule(mesh, &CollisionRules::body_separations, {{0, 0, 1}, s});
  };
  CHECK_THROWS_WITH(bodies({0, 2, 1}), Contains("body_separations row 1: id 2 is out of range, there are 2"));
  CHECK_THROWS_WITH(bodies({-1, 0, 1}), Contains("row 1: id -1"));
  CHECK_THROWS_WITH(bodies({0, 0, 2}), Contains("row 1: bodies 0 and 0 are repeated"));
  CHECK_THROWS_WITH(bodies({1, 0, -1}), Contains("row 1: -1.0") && Contains("at most 2^1020"));
  CHECK_THROWS_WITH(bodies({1, 0, NAN}), Contains("row 1: nan"));
  CHECK_THROWS_WITH(bodies({1, 0, 0x1p1021}), Contains("row 1"));
  CHECK_NOTHROW(bodies({1, 0, 0x1p1020}));
  CHECK_THROWS_WITH(set_rule(mesh, &CollisionRules::bodies, {}), Contains("body_separations row 1: id 1"));
  Eigen::MatrixXd rest = Eigen::MatrixXd::Zero(16, 3);
  const auto shape = [&](const Eigen::MatrixXd& x) { set_rule(mesh, &CollisionRules::rest_positions, x); };
  CHECK_THROWS_WITH(shape(rest.topRows(15)),
                    Contains("rest_positions has 15 rows of 3 coordinates for 16 vertices"));
  CHECK_THROWS_WITH(shape(rest.leftCols(2)), Contains("16 rows of 2"));
  for (const double bad : {double(NAN), double(INFINITY), -0x1p1021}) {
    rest(7, 1) = bad;
    CHECK_THROWS_WITH(shape(rest), Contains("rest_positions row 7"));
  }
  for (const double bad : {0.0, 1.0, -0.5, double(NAN)})
    CHECK_THROWS_WITH(set_rule(mesh, &CollisionRules::rest_share, bad), Contains("rest_share is"));
  CHECK_THROWS_WITH(set_rule(mesh, &CollisionRules::excluded_rings, -2), Contains("excluded_rings is -2"));
}

TEST_CASE("points are vertices of no edge or face, each once, after the edges", "[unit]") {
  Eigen::MatrixXi edges(1, 2), faces(1, 3);
  edges << 3, 4;
  faces << 0, 1, 2;
  Mesh mesh(8, complete_edges(edges, faces), faces);
  const auto set_points = [&](const std::vector<int>& ids) { set_rule(mesh, &CollisionRules::points, ids); };
  set_points({7, 5});
  CHECK((mesh.num_edges() == 6 && mesh.num_points() == 2));
  CHECK((mesh.edge(4) == std::array<int, 2>{7, 7} && mesh.edge(5) == std::array<int, 2>{5, 5}));
  CHECK_THROWS_WITH(set_points({5, 8}), Contains("points row 1: vertex 8 is out of range"));
  CHECK_THROWS_WITH(set_points({-1}), Contains("points row 0: vertex -1"));
  CHECK_THROWS_WITH(set_points({5, 6, 5}), Contains("points row 2: vertex 5 is repeated"));
  CHECK_THROWS_WITH(set_points({4}), Contains("points row 0: vertex 4 belongs to an edge"));
  CHECK_THROWS_WITH(set_points({5, 2}), Contains("points row 1: vertex 2 belongs to an edge or a face"));
  CHECK((mesh.num_edges() == 6 && mesh.edge(4)[0] == 7));
  set_points({6});
  CHECK((mesh.num_edges() == 5 && mesh.edge(4)[0] == 6 && mesh.filter_counts().edge_edge.pairs == 10));
  set_points({});
  CHECK((mesh.num_edges() == 4 && mesh.num_points() == 0));
  edges << 3, 3;
  CHECK_THROWS_WITH(Mesh(8, edges, faces), Contains("edge row 0: vertex 3 is repeated"));
}

TEST_CASE("a mesh made of nothing is one without vertices, to be assigned to", "[unit]") {
  const Eigen::MatrixXd none(0, 3);
  Mesh mesh;
  CHECK((mesh.num_vertices() == 0 && mesh.num_edges() == 0));
  CHECK((mesh.num_faces() == 0 && mesh.num_points() == 0));
  CHECK((mesh.num_bodies() == 1 && mesh.num_full_vertices() == 0 && mesh.components().empty()));
  CHECK(same_rules(mesh.rules(), CollisionRules()));
  CHECK(mesh.filter_counts().vertex_face.pairs + mesh.filter_counts().edge_edge.pairs == 0);
  CHECK(compute_collision_free_stepsize(mesh, none, none).step == 1);
  CHECK(construct_active_set(mesh, none, none).empty());
  CHECK(check(mesh, none).clean());
  CHECK_THROWS_AS(construct_active_set(mesh, Eigen::MatrixXd::Zero(1, 3), none), std::invalid_argument);
  CollisionRules weld, point;
  weld.weld = true, point.points = {0};
  CHECK_NOTHROW(mesh.set_rules(weld));
  CHECK_THROWS_WITH(mesh.set_rules(point), Contains("points row 0"));
  CHECK(mesh.rules().weld);
  mesh.release_memory();

  const Everything all;
  mesh = all.mesh(all.rules);
  CHECK(same_rules(mesh.rules(), all.rules));
  CHECK(same_bytes(all.ask(mesh), all.ask(all.mesh(all.rules))));
}
