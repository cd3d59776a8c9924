// Meshes without vertices, faces or edges are free.
#include <string>

#include "tests/catch.hpp"
#include "tests/src/support/scene_set.hpp"

using namespace onset;

static void expect_free(const Mesh& mesh, const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  for (BroadPhaseMethod method :
       {BroadPhaseMethod::automatic, BroadPhaseMethod::brute, BroadPhaseMethod::bvh})
    for (double separation : {0.0, 10.0}) {
      Options o;
      o.broad_phase = method;
      o.min_separation = separation;
      const StepResult r = compute_collision_free_stepsize(mesh, a, b, o);
      CHECK(r.outcome == Outcome::free);
      CHECK(r.step == 1);
      CHECK_FALSE(r.limiting);
      const ActiveSet s = construct_active_set(mesh, a, b, o);
      CHECK(s.outcome == Outcome::free);
      CHECK(s.size() == 0);
      CHECK(s.earliest() == nullptr);
      CHECK(is_step_collision_free(mesh, a, b, o));
      CHECK(compute_candidates(mesh, a, b, o).counts.total() == 0);
    }
}

TEST_CASE("nothing at all", "[unit]") {
  const Eigen::MatrixXd none(0, 3);
  expect_free(Mesh(none, Eigen::MatrixXi(0, 3)), none, none);
  expect_free(Mesh(0, Eigen::MatrixXi(0, 2), Eigen::MatrixXi(0, 3)), none, none);
  expect_free(Mesh(0, Indices{}, Indices{}), none, none);
  expect_free(Mesh(), none, none);
}

TEST_CASE("vertices alone", "[unit]") {
  Eigen::MatrixXd a(3, 3), b(3, 3);
  a << 0, 0, 0, 1, 1, 1, 2, 0, 1;
  b << 1, 1, 1, 0, 0, 0, 0, 0, 0;
  expect_free(Mesh(3, Eigen::MatrixXi(0, 3)), a, b);
}

TEST_CASE("one face, or one edge, has nothing to meet", "[unit]") {
  Eigen::MatrixXd a(3, 3), b(3, 3);
  a << 0, 0, 0, 1, 1, 1, 2, 0, 1;
  b << 1, 1, 1, 0, 0, 0, 0, 0, 0;
  Eigen::MatrixXi F(1, 3), E(1, 2);
  F << 0, 1, 2, E << 0, 1;
  expect_free(Mesh(3, F), a, b);
  expect_free(Mesh(3, E, Eigen::MatrixXi(0, 3)), a, b);
}

TEST_CASE("edges without faces meet each other, a face meets a vertex of no other", "[unit]") {
  Eigen::MatrixXd a(4, 3), b(4, 3);
  a << -1, 0, 1, 1, 0, 1, 0, -1, 0, 0, 1, 0;
  b = a;
  b(0, 2) = b(1, 2) = -1;
  Eigen::MatrixXi E(2, 2);
  E << 0, 1, 2, 3;
  const StepResult edges = compute_collision_free_stepsize(Mesh(4, E, Eigen::MatrixXi(0, 3)), a, b);
  CHECK(edges.outcome == Outcome::contact);
  REQUIRE(edges.limiting);
  CHECK(edges.limiting->kind == PairKind::edge_edge);
  CHECK(edges.step > 0.499);
  CHECK(edges.step <= 0.5);

  a << 0, 0, 1, -1, -1, 0, 1, -1, 0, 0, 1, 0;
  b = a;
  b(0, 2) = -1;
  Eigen::MatrixXi F(1, 3);
  F << 1, 2, 3;
  const StepResult face = compute_collision_free_stepsize(Mesh(4, F), a, b);
  CHECK(face.outcome == Outcome::contact);
  REQUIRE(face.limiting);
  CHECK(face.limiting->kind == PairKind::vertex_face);
  CHECK(std::string(to_string(face.limiting->kind)) == "vertex_face");
  CHECK(std::string(to_string(PairKind::edge_edge)) == "edge_edge");
  CHECK(face.step > 0.499);
  CHECK(face.step <= 0.5);
}
