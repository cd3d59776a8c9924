// What a mesh is made of, its map to the full one, and the same answers with less work.
#include <algorithm>
#include <atomic>
#include <cstring>
#include <onset/onset.hpp>
#include <stdexcept>
#include <thread>

#include "tests/catch.hpp"
#include "tests/scenes/meshes.hpp"
#include "tests/scenes/rules.hpp"

using namespace onset;
using scenes::Scene;
using scenes::set_rule;

namespace {

bool same_answer(const ActiveSet& a, const ActiveSet& b) {
  const auto same = [](const Contact& c, const Contact& d) {
    return c.kind == d.kind && c.a == d.a && c.b == d.b && c.outcome == d.outcome &&
           std::memcmp(&c.toi, &d.toi, sizeof(double)) == 0;
  };
  return a.outcome == b.outcome && std::equal(a.begin(), a.end(), b.begin(), b.end(), same);
}

// A cube at rest after a shaken sphere that falls onto it: static from its first vertex on.
Scene onto_static(double fall, unsigned seed) {
  scenes::Random random(seed);
  Scene ball = scenes::translated(scenes::sphere(7, 12), {0, 0, 2.25});
  scenes::displace(ball, {0, 0, -fall});
  scenes::shake(ball, 0.05, random);
  Scene scene = scenes::joined(ball, scenes::cube());
  for (Eigen::MatrixXd* x : {&scene.x_t0, &scene.x_t1}) x->col(0) *= 2, x->col(1) *= 1.25;  // no axes alike
  return scene;
}
std::vector<bool> last_eight(const Scene& scene) {
  std::vector<bool> flags(std::size_t(scene.x_t0.rows()));
  for (std::size_t v = flags.size() - 8; v < flags.size(); ++v) flags[v] = true;
  return flags;
}

}  // namespace

TEST_CASE("faces need their edges: what is missing is named, and complete_edges adds it", "[unit]") {
  Eigen::MatrixXi F(3, 3), E(3, 2);
  F << 0, 1, 2, 2, 1, 3, 4, 5, 6;
  E << 7, 3, 1, 0, 2, 1;
  const Eigen::MatrixXd x = Eigen::MatrixXd::Random(8, 3);
  CHECK_THROWS_WITH(Mesh(8, E, F), Catch::Contains("face row 0") && Catch::Contains("vertices 0 and 2") &&
                                       Catch::Contains("onset::complete_edges"));
  CHECK_THROWS_WITH(Mesh(x, E, F), Catch::Contains("face row 0") && Catch::Contains("vertices 0 and 2"));
  CHECK_THROWS_WITH(Mesh(8, Eigen::MatrixXi(0, 2), F), Catch::Contains("face row 0"));
  const Eigen::MatrixXi all = complete_edges(E, F);
  REQUIRE(all.rows() == 9);
  CHECK(all.topRows(3) == E);
  Eigen::MatrixXi rest(6, 2);  // by the larger vertex, then by the smaller
  rest << 0, 2, 1, 3, 2, 3, 4, 5, 4, 6, 5, 6;
  CHECK(all.bottomRows(6) == rest);
  CHECK_THROWS_WITH(Mesh(8, Eigen::MatrixXi(all.topRows(8)), F),
                    Catch::Contains("face row 2") && Catch::Contains("vertices 5 and 6"));
}

TEST_CASE("complete edges of random faces are those given, then the others in the order of edges",
          "[property]") {
  scenes::Random random(31);
  for (int round = 0; round < 50; ++round) {
    const Scene scene = scenes::joined(scenes::cube(), scenes::sphere(3 + round % 3, 5));
    const Eigen::MatrixXi derived = edges(scene.faces);
    Eigen::MatrixXi some(scenes::integer(random, 0, 20), 2);
    for (Eigen::Index e = 0; e < some.rows(); ++e) {
      const Eigen::RowVector2i one = derived.row(scenes::integer(random, 0, int(derived.rows()) - 1));
      some.row(e) = scenes::coin(random) ? one : Eigen::RowVector2i(one.reverse());
    }
    const Eigen::MatrixXi all = complete_edges(some, scene.faces);
    CHECK(all.topRows(some.rows()) == some);
    Eigen::Index next = some.rows();
    for (Eigen::Index e = 0; e < derived.rows(); ++e) {
      bool given = false;
      for (Eigen::Index g = 0; g < some.rows(); ++g)
        given = given || some.row(g) == derived.row(e) ||
                some.row(g) == Eigen::RowVector2i(derived.row(e).reverse());
      if (!given) CHECK(all.row(next++) == derived.row(e));
    }
    CHECK(next == all.rows());
    CHECK(Mesh(scene.x_t0, all, scene.faces).num_edges() == all.rows());
  }
  CHECK_THROWS_WITH(complete_edges(Eigen::RowVector2i(0, -1), Eigen::MatrixXi(0, 3)),
                    Catch::Contains("edge row 0"));
  CHECK_THROWS_AS(complete_edges(Eigen::RowVector3i(0, 1, 2), Eigen::MatrixXi(0, 3)), std::invalid_argument);
}

TEST_CASE("full vertices out of range or repeated are named by row", "[unit]") {
  Mesh mesh(4, Eigen::MatrixXi((Eigen::MatrixXi(1, 3) << 1, 2, 3).finished()));
  CHECK_THROWS_WITH(mesh.set_full_vertices({2, 2, 2, 2}, 30),
                    Catch::Contains("full vertices row 1") && Catch::Contains("repeated"));
  CHECK_THROWS_WITH(mesh.set_full_vertices({0, 1, 2, 30}, 30), Catch::Contains("full vertices row 3"));
  CHECK_THROWS_WITH(mesh.set_full_vertices({0, -1, 2, 3}, 30), Catch::Contains("full vertices row 1"));
  CHECK_THROWS_WITH(mesh.set_full_vertices({0}, 30), Catch::Contains("1 values for 4 vertices"));
  CHECK((mesh.num_full_vertices() == 4 && mesh.full_vertex(3) == 3));
}

TEST_CASE("ids and degrees of freedom map to the full mesh", "[unit]") {
  Mesh mesh(4, Eigen::MatrixXi((Eigen::MatrixXi(1, 3) << 1, 2, 3).finished()));
  CHECK(mesh.full_vertex(2) == 2);
  mesh.set_full_vertices({5, 9, 0, 7}, 10);
  CHECK(mesh.num_full_vertices() == 10);
  const Pair pair{PairKind::vertex_face, 0, 0, {0, 1, 2, 3}};
  CHECK(mesh.full_vertices(pair) == std::array<int, 4>{5, 9, 0, 7});
  CHECK(mesh.full_dofs(pair) == std::array<std::ptrdiff_t, 12>{15, 16, 17, 27, 28, 29, 0, 1, 2, 21, 22, 23});
  CHECK(mesh.full_vertices(Pair{}) == std::array<int, 4>{-1, -1, -1, -1});
  CHECK(mesh.full_dofs(Pair{})[11] == -1);
  const Eigen::MatrixXd full = Eigen::MatrixXd::Random(10, 3);
  const std::vector<double> surface = mesh.surface_positions(full);
  REQUIRE(surface.size() == 12);
  CHECK(surface[3] == full(9, 0));
  CHECK(surface[11] == full(7, 2));
  CHECK_THROWS_AS(mesh.surface_positions(full.topRows(4)), std::invalid_argument);
  CHECK_THROWS_AS(mesh.surface_positions(full.leftCols(2)), std::invalid_argument);
  CHECK_THROWS_WITH(compute_collision_free_stepsize(mesh, full, full),
                    Catch::Contains("full mesh") && Catch::Contains("surface_positions"));
}

TEST_CASE("a point against a face and wires against each other are found", "[unit]") {
  // A point falls through a triangle, a wire through another wire and the triangle's edge.
  Eigen::MatrixXd x(8, 3);
  x << 0, 0, 0, 4, 0, 0, 0, 4, 0, /* point */ 1, 1, 1, /* wires */ 10, -1, 0, 10, 1, 0, 9, 0, 1, 11, 0, 1;
  Eigen::MatrixXd end = x;
  for (int v : {3, 6, 7}) end(v, 2) = -1;
  Eigen::MatrixXi faces(1, 3), edges(5, 2);
  faces << 0, 1, 2;
  edges << 0, 1, 1, 2, 2, 0, 4, 5, 6, 7;
  const ActiveSet set = construct_active_set(Mesh(8, edges, faces), x, end);
  REQUIRE(set.size() == 2);
  CHECK(set[0].vertices == std::array<int, 4>{3, 0, 1, 2});
  CHECK(set[1].vertices == std::array<int, 4>{4, 5, 6, 7});
  for (const Contact& contact : set) CHECK(contact.toi == Approx(0.5).epsilon(1e-4));
}

TEST_CASE("static vertices give the same answers and are boxed once", "[property]") {
  const Scene first = onto_static(0.75, 1);
  for (const double separation : {0.0, 0.02}) {
    Mesh fixed(first.x_t0, first.faces);
    const Mesh plain = fixed;
    set_rule(fixed, &CollisionRules::static_vertices, last_eight(first));
    int contacts = 0;
    for (unsigned seed = 1; seed <= 12; ++seed) {
      const Scene scene = onto_static(seed % 2 == 0 ? 0.75 : 0.1, seed);
      Options o;
      o.min_separation = separation;
      o.tolerance = 1e-6;  // the relative one changes with the pairs that there can be
      const ActiveSet expected = construct_active_set(plain, scene.x_t0, scene.x_t1, o);
      for (const BroadPhaseMethod method :
           {BroadPhaseMethod::bvh, BroadPhaseMethod::hash, BroadPhaseMethod::brute}) {
        o.broad_phase = method;
        const ActiveSet found = construct_active_set(fixed, scene.x_t0, scene.x_t1, o);
        CHECK(same_answer(found, expected));
        CHECK(found.stats.made_static_boxes == (seed == 1 && method == BroadPhaseMethod::bvh));
      }
      o.broad_phase = BroadPhaseMethod::automatic;
      const StepResult step = compute_collision_free_stepsize(fixed, scene.x_t0, scene.x_t1, o);
      CHECK(step.step == compute_collision_free_stepsize(plain, scene.x_t0, scene.x_t1, o).step);
      CHECK(!step.stats.made_static_boxes);
      const LineSearch search(fixed, scene.x_t0, scene.x_t1 - scene.x_t0, o);
      const LineSearch usual(plain, scene.x_t0, scene.x_t1 - scene.x_t0, o);
      CHECK(search.largest_step().step == usual.largest_step().step);
      contacts += expected.size() > 0;
    }
    CHECK(contacts == 6);
  }
}

TEST_CASE("static vertices found elsewhere are boxed again, and must not move in a step", "[unit]") {
  const Scene scene = onto_static(0.75, 1);
  Mesh mesh(scene.x_t0, scene.faces);
  const Mesh plain = mesh;
  set_rule(mesh, &CollisionRules::static_vertices, last_eight(scene));
  const auto ask = [&](const Scene& s) {
    const ActiveSet set = construct_active_set(mesh, s.x_t0, s.x_t1);
    CHECK(same_answer(set, construct_active_set(plain, s.x_t0, s.x_t1)));
    return set;
  };
  CHECK(ask(scene).stats.made_static_boxes);
  CHECK(!ask(scene).stats.made_static_boxes);
  Scene lower = scene;  // out of reach, then back
  lower.x_t0.bottomRows(8).col(2).array() -= 3, lower.x_t1.bottomRows(8).col(2).array() -= 3;
  const ActiveSet missed = ask(lower);
  CHECK(missed.stats.made_static_boxes);
  CHECK(missed.size() == 0);
  CHECK(ask(scene).size() > 0);
  Scene wrong = scene;
  wrong.x_t1(wrong.x_t1.rows() - 3, 1) += 1e-9;
  const std::string name = "vertex " + std::to_string(wrong.x_t1.rows() - 3) + " is static";
  CHECK_THROWS_WITH(construct_active_set(mesh, wrong.x_t0, wrong.x_t1), Catch::Contains(name));
  wrong.x_t1(wrong.x_t1.rows() - 3, 1) = NAN;
  const ActiveSet undone = construct_active_set(mesh, wrong.x_t0, wrong.x_t1);
  CHECK(undone.outcome == Outcome::non_finite);
  CHECK(undone.vertex == int(wrong.x_t1.rows() - 3));
  wrong.x_t1 = scene.x_t1, wrong.x_t1(0, 0) = INFINITY;
  CHECK(construct_active_set(mesh, wrong.x_t0, wrong.x_t1).vertex == 0);
  CHECK(ask(scene).size() > 0);
}

TEST_CASE("threads that share a mesh and disagree on where it stands get their own answers",
          "[determinism]") {
  Scene here = onto_static(0.75, 3), there = here;
  Mesh mesh(here.x_t0, here.faces);
  const Mesh plain = mesh;
  set_rule(mesh, &CollisionRules::static_vertices, last_eight(here));
  for (Eigen::MatrixXd* x : {&there.x_t0, &there.x_t1}) x->bottomRows(8).col(0).array() += 0.5;
  const ActiveSet expected[2] = {construct_active_set(plain, here.x_t0, here.x_t1),
                                 construct_active_set(plain, there.x_t0, there.x_t1)};
  REQUIRE(!same_answer(expected[0], expected[1]));
  std::atomic<int> wrong{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < 8; ++t)
    threads.emplace_back([&, t] {
      for (int i = 0; i < 20; ++i) {
        const int which = (t + i / 4) % 2;
        const Scene& s = which == 0 ? here : there;
        wrong += !same_answer(construct_active_set(mesh, s.x_t0, s.x_t1), expected[which]);
      }
    });
  for (std::thread& t : threads) t.join();
  CHECK(wrong == 0);
}

TEST_CASE("a thousand rigid bodies make no pair within a body", "[property]") {
  Scene all = scenes::cube();
  for (int i = 1; i < 10; ++i) all = scenes::joined(all, scenes::translated(scenes::cube(), {2.1 * i, 0, 0}));
  for (int k = 0; k < 2; ++k) {  // a row, a layer, a block
    const Scene row = all;
    for (int i = 1; i < 10; ++i)
      all = scenes::joined(all, scenes::translated(row, {0, k == 0 ? 2.1 * i : 0, k == 1 ? 2.1 * i : 0}));
  }
  scenes::Random random(8);
  scenes::shake(all, 0.3, random);
  Mesh mesh(all.x_t0, all.faces);
  set_rule(mesh, &CollisionRules::bodies, mesh.components());
  REQUIRE(mesh.num_bodies() == 1000);
  const Candidates before = compute_candidates(mesh, all.x_t0, all.x_t1);
  set_rule(mesh, &CollisionRules::rigid_bodies, std::vector<bool>(1000, true));
  const Candidates found = compute_candidates(mesh, all.x_t0, all.x_t1);
  const auto body = [&](bool edge, int id) { return mesh.body(edge ? mesh.edge(id)[0] : id); };
  std::vector<std::array<int, 2>> vf, ee;
  for (const auto& [v, f] : before.vertex_face)
    if (mesh.body(v) != mesh.body(mesh.face(f)[0])) vf.push_back({v, f});
  for (const auto& [e, f] : before.edge_edge)
    if (body(true, e) != body(true, f)) ee.push_back({e, f});
  CHECK(vf.size() > 1000);
  CHECK(vf.size() < before.vertex_face.size());
  CHECK((found.vertex_face == vf));
  CHECK((found.edge_edge == ee));
  CHECK(found.stats.filter_counts.vertex_face.same_body == 1000 * 8 * 12);
  CHECK(found.stats.filter_counts.edge_edge.same_body == 1000 * 18 * 17 / 2);
}

TEST_CASE("a mesh that was moved from has no vertices, and can be used again", "[unit]") {
  Eigen::MatrixXi F(1, 3);
  F << 0, 1, 2;
  Mesh first(3, F);
  const Mesh second(std::move(first));
  CHECK((second.num_vertices() == 3 && first.num_vertices() == 0 && first.num_faces() == 0));  // NOLINT
  first = second;
  CHECK(first.num_faces() == 1);
  Mesh third;
  third = std::move(first);
  CHECK((third.num_faces() == 1 && first.num_vertices() == 0));  // NOLINT
  first.set_rules({});
  first.release_memory();
  CHECK(compute_collision_free_stepsize(first, Eigen::MatrixXd(0, 3), Eigen::MatrixXd(0, 3)).step == 1);
}
