// Calls everything that onset.hpp offers on a scene with a known answer, and prints the results bit by bit:
// the output is the same however this program and the library were built.
#include <array>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <limits>
#include <onset/onset.hpp>

Eigen::Index edges_of_a_tetrahedron();  // second_unit.cpp

namespace {

int failures = 0;

void expect(bool ok, const char* what) {
  if (!ok) std::printf("FAILED: %s\n", what);
  failures += !ok;
}

// Two triangles over each other, 1 apart; the upper one falls by 2, turned so that all kinds of pairs occur.
struct Scene {
  Eigen::MatrixXd x0{6, 3}, x1{6, 3};
  Eigen::MatrixXi F{2, 3};
  Scene() {
    x0 << 0, 0, 0, 4, 0, 0, 0, 4, 0, 0.5, 0.5, 1, 3, 0.5, 1.25, 0.5, 3, 1.5;
    x1 = x0;
    x1.bottomRows(3).col(2).array() -= 2;
    F << 0, 1, 2, 3, 4, 5;
  }
};

void whole_steps(const Scene& s, const onset::Mesh& mesh) {
  const onset::StepResult step = onset::compute_collision_free_stepsize(mesh, s.x0, s.x1);
  expect(step.outcome == onset::Outcome::contact, "the falling triangle meets the other");
  expect(step.step <= 0.5 && step.step > 0.499, "the step ends just before t = 1/2");
  std::printf("step %a %s\n", step.step, onset::to_string(step.outcome));
  expect(!onset::is_step_collision_free(mesh, s.x0, s.x1), "the whole step is not free");
  expect(onset::is_step_collision_free(mesh, s.x0, s.x0 + 0.25 * (s.x1 - s.x0)), "a quarter of it is");

  const onset::ActiveSet active = onset::construct_active_set(mesh, s.x0, s.x1);
  expect(active.size() > 0, "the active set has contacts");
  for (const onset::Contact& c : active) std::printf("contact %d %d %d %a\n", int(c.kind), c.a, c.b, c.toi);
  const onset::Candidates pairs = onset::compute_candidates(mesh, s.x0, s.x1);
  expect(pairs.vertex_face.size() + pairs.edge_edge.size() >= active.size(), "contacts are candidates");
  std::atomic<std::size_t> visited{0};
  onset::visit_candidates(mesh, s.x0, s.x1,
                          [&](onset::PairKind, const std::array<int, 2>*, std::size_t n) { visited += n; });
  expect(onset::count_candidates(mesh, s.x0, s.x1).counts.total() == pairs.counts.total(),
         "candidates are counted");
  expect(std::int64_t(visited) == pairs.counts.total(), "candidates are visited");
}

void rules(const Scene& s) {
  onset::Mesh mesh;
  mesh = onset::Mesh(s.x0, s.F);
  onset::CollisionRules rules;
  rules.bodies = mesh.components();
  rules.excluded_bodies = {{0, 1}};
  mesh.set_rules(rules);
  expect(onset::is_step_collision_free(mesh, s.x0, s.x1), "bodies that are excluded pass through each other");
  expect(mesh.rules().excluded_bodies.size() == 1, "a mesh tells its rules");
}

// What holds memory is made on one side of the library's boundary and freed on the other, where Eigen may
// allocate differently.
void memory_of_both_sides(const Scene& s) {
  onset::RigidTrajectory motion(s.x0);
  motion.add_body(3, 6, {0, 0, 1}, {0, 0, -2}, {0.5, 0.5, 1});
  onset::Mesh mesh(s.x0, s.F);
  onset::CollisionRules rules = mesh.rules();
  rules.rest_positions = s.x0;
  rules.rest_share = 0.25;
  mesh.set_rules(rules);
  rules = mesh.rules();
  expect(rules.rest_positions.rows() == 6 && rules.rest_positions(4, 2) == 1.25,
         "a mesh tells its shape at rest");
  onset::Options far;
  far.min_separation = 10;
  expect(onset::compute_collision_free_stepsize(mesh, s.x0, s.x1, far).step > 0,
         "the separation is a share of that at rest");
  rules.rest_positions = {};
  mesh.set_rules(rules);
  const double step = onset::compute_collision_free_stepsize(mesh, motion).step;
  expect(step <= 0.5 && step > 0.4, "a triangle that turns meets the other");
  std::printf("turning %a", step);
  for (int i = 0; i < 100; ++i) {
    const Eigen::MatrixXd x = motion.at(step);
    if (i == 99) std::printf(" %a %a\n", x(4, 0), x(4, 2));
  }
}

void line_search(const Scene& s, const onset::Mesh& mesh) {
  const onset::LineSearch search(mesh, s.x0, s.x1 - s.x0);
  const onset::LineSearchStep step = search.largest_step();
  expect(step.step < 0.5 && step.step > 0.25, "the line search keeps a share of the gap");
  std::printf("line search %a\n", step.step);
}

void not_a_number(const Scene& s, const onset::Mesh& mesh) {
  Eigen::MatrixXd bad = s.x1;
  bad(4, 1) = std::numeric_limits<double>::quiet_NaN();
  const onset::StepResult step = onset::compute_collision_free_stepsize(mesh, s.x0, bad);
  expect(step.outcome == onset::Outcome::non_finite && step.vertex == 4, "NaN is found under any flags");
}

void single_queries() {
  onset::VertexFaceQuery vf;
  vf.t0 = {{{0.25, 0.25, 1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  vf.t1 = vf.t0;
  vf.t1[0][2] = -1;
  const onset::QueryResult a = onset::vertex_face_ccd(vf);
  expect(a.collides() && a.toi <= 0.5 && a.toi > 0.499, "vertex-face query");
  onset::EdgeEdgeQuery ee;
  ee.t0 = {{{-1, 0, 1}, {1, 0, 1}, {0, -1, 0}, {0, 1, 0}}};
  ee.t1 = ee.t0;
  ee.t1[0][2] = ee.t1[1][2] = -3;
  const onset::QueryResult b = onset::edge_edge_ccd(ee);
  expect(b.collides() && b.toi <= 0.25 && b.toi > 0.249, "edge-edge query");
  std::printf("queries %a %a\n", a.toi, b.toi);
}

}  // namespace

int main() {
  const Scene scene;
  const onset::Mesh mesh(scene.x0, scene.F);
  expect(edges_of_a_tetrahedron() == 6, "edges, called from a second translation unit");
  whole_steps(scene, mesh);
  rules(scene);
  memory_of_both_sides(scene);
  line_search(scene, mesh);
  not_a_number(scene, mesh);
  single_queries();
  return failures;
}
