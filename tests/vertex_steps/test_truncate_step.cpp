// A step for each vertex, on scenes whose answer is known.
#include <Eigen/Geometry>
#include <onset/intersections.hpp>
#include <onset/truncate_step.hpp>

#include "tests/catch.hpp"
#include "tests/narrowphase/kernel/kernels.hpp"
#include "tests/scenes/meshes.hpp"
#include "tests/src/support/answer.hpp"
#include "tests/src/support/scene_set.hpp"
#include "tests/steps/support/mesh_state.hpp"

using namespace onset;
using namespace onset::tests;
using Eigen::MatrixXd;

namespace {

MatrixXd matrix(const std::vector<double>& rows) {
  return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>>(
      rows.data(), Eigen::Index(rows.size() / 3), 3);
}

// A vertex of a small triangle above a large one, at height `gap`, and both triangles' motions along z.
struct Drop {
  MatrixXd x{6, 3}, x_new;
  Mesh mesh;
  Drop(double gap, double upper, double lower) {
    Eigen::MatrixXi F(2, 3);
    F << 0, 1, 2, 3, 4, 5;
    x << -4, -4, 0, 4, -4, 0, 0, 4, 0, 0, 0, gap, 0.5, 0, gap + 2, 0, 0.5, gap + 2;
    x_new = x;
    x_new.col(2).head(3).array() += lower, x_new.col(2).tail(3).array() += upper;
    mesh = Mesh(x, F);
  }
  TruncatedStep step(const TruncateOptions& o = {}) const { return truncate_step(mesh, x, x_new, o); }
};

TruncateOptions with_share(double share) {
  TruncateOptions o;
  o.gap_share = share;
  return o;
}

}  // namespace

TEST_CASE("an obstacle that rests leaves all of the gap to what falls on it", "[unit]") {
  const Drop drop(1, -2, 0);
  const TruncatedStep r = drop.step(with_share(0.1));
  CHECK(r.outcome == Outcome::contact);
  CHECK(std::fabs(r.share[3] - 0.45) < 1e-9);  // 0.9 of the gap, of a way of 2
  for (const int v : {0, 1, 2, 4, 5}) CHECK(r.share[std::size_t(v)] == 1);
  REQUIRE(r.limiting);
  CHECK((r.limiting->kind == PairKind::vertex_face && r.limiting->a == 3 && r.limiting->b == 0));
  CHECK(r.limited_by[3] == 0);
  CHECK(std::fabs(r.kept - (2 + 2 + 0.9) / 6) < 1e-9);
}

TEST_CASE("two that approach each other share the gap as they approach", "[unit]") {
  const Drop drop(1, -3, 1);
  const TruncatedStep r = drop.step(with_share(0));
  CHECK(std::fabs(r.share[3] - 0.25) < 1e-9);
  for (const std::size_t v : {0u, 1u, 2u}) CHECK(std::fabs(r.share[v] - 0.25) < 1e-9);
  CHECK(r.positions[11] > r.positions[2]);
}

TEST_CASE("what parts, and what slides beside, keeps all", "[unit]") {
  for (const double gap : {1e-12, 1.0}) {
    const TruncatedStep apart = Drop(gap, 1, -1).step();
    CHECK((apart.outcome == Outcome::free && apart.kept == 1 && apart.pairs.empty() && !apart.limiting));
    Drop beside(gap, 0, 0);
    beside.x_new.col(0).tail(3).array() += 1;
    const TruncatedStep slid = beside.step();
    CHECK((slid.outcome == Outcome::free && slid.kept == 1));
    CHECK(matrix(slid.positions) == beside.x_new);
  }
}

TEST_CASE("steps that follow one another approach a contact and never reach it", "[unit]") {
  Drop drop(1, -2, 0);
  MatrixXd x = drop.x;
  double gap = 1;
  for (int i = 0; i < 12; ++i) {
    const TruncatedStep r = truncate_step(drop.mesh, x, drop.x_new);
    x = matrix(r.positions);
    const double next = x(3, 2);
    CAPTURE(i, gap, next);
    CHECK((next > 0 && next < gap && next < 0.11 * gap));
    gap = next;
  }
  CHECK(gap < 1e-11);
}

TEST_CASE("a pair that touches stays, and is named; one within its separation may part", "[unit]") {
  Drop drop(0, -1, 0);
  TruncatedStep r = drop.step();
  CHECK(r.outcome == Outcome::initial_contact);
  REQUIRE(r.limiting);
  CHECK((r.limiting->kind == PairKind::vertex_face && r.limiting->a == 3));
  for (const std::size_t v : {0u, 1u, 2u, 3u}) CHECK(r.share[v] == 0);
  CHECK((r.share[4] == 1 && r.share[5] == 1));

  Options o;
  o.min_separation = 0.5;
  r = Drop(0.25, -1, 0).step(o);
  CHECK((r.outcome == Outcome::contact && r.share[3] == 0));
  r = Drop(0.25, 1, 0).step(o);
  CHECK((r.share[3] == 1 && r.kept == 1));
}

TEST_CASE("separation, thickness and the maximum norm are kept", "[unit]") {
  Drop drop(1, -2, 0);
  CollisionRules rules;
  rules.thickness = {0, 0, 0, 0.25, 0, 0};
  drop.mesh.set_rules(rules);
  TruncateOptions o = with_share(0);
  o.min_separation = 0.25;
  for (const Norm norm : {Norm::euclidean, Norm::maximum}) {
    o.norm = norm;
    const TruncatedStep r = drop.step(o);
    CHECK(std::fabs(r.share[3] - 0.25) < 1e-9);
    CHECK(r.positions[11] > 0.5);
  }
}

TEST_CASE("what starts nearly at its separation in the maximum norm stays there", "[unit]") {
  CollisionRules rules;
  rules.points = {0, 1};
  const Mesh mesh(2, Eigen::MatrixXi(0, 3), rules);
  for (const double gap : {1e-13, 2e-14, 1e-14, 7e-15, 3e-15, 1e-15, 0.0}) {
    MatrixXd x(2, 3), x_new(2, 3);
    x << 0, 0, 0, 1 + gap, 0.9, 0;
    x_new << 0, 0, 0, 0.96, 0.95, 0;
    TruncateOptions o;
    o.norm = Norm::maximum, o.min_separation = 1;
    const MatrixXd end = matrix(truncate_step(mesh, x, x_new, o).positions);
    CAPTURE(gap);
    CHECK((end.row(1) - end.row(0)).cwiseAbs().maxCoeff() >= 1);
  }
}

TEST_CASE("points meet each other where they are declared", "[unit]") {
  MatrixXd x(2, 3), x_new(2, 3);
  x << 0, 0, 0, 4, 0, 0;
  x_new << 8, 0, 0, 4, 0, 0;
  CollisionRules rules;
  rules.points = {0, 1};
  const Mesh free(2, Eigen::MatrixXi(0, 3)), mesh(2, Eigen::MatrixXi(0, 3), rules);
  CHECK(truncate_step(free, x, x_new).kept == 1);
  TruncateOptions o = with_share(0);
  o.min_separation = 1;
  const TruncatedStep r = truncate_step(mesh, x, x_new, o);
  CHECK((std::fabs(r.share[0] - 0.375) < 1e-9 && r.positions[0] < 3 && r.outcome == Outcome::contact));
}

TEST_CASE("d-hat is twice the longest way", "[unit]") {
  TruncateOptions o;
  o.d_hat = 0.5;
  const Drop drop(1, -2, 0);
  const TruncatedStep r = drop.step(o);
  CHECK(r.outcome == Outcome::free);
  for (const std::size_t v : {3u, 4u, 5u}) {
    CHECK((std::fabs(r.share[v] - 0.125) < 1e-12 && r.limited_by[v] == -1));
    CHECK(std::fabs(r.positions[3 * v + 2] - drop.x(Eigen::Index(v), 2) + 0.25) < 1e-12);
  }
}

TEST_CASE("d-hat leaves a rigid body in one piece, and what is wrong is named", "[unit]") {
  MatrixXd x(6, 3);  // a tip above a wide face
  x << 10, 0, 0, -5, 8, 0, -5, -8, 0, 0, 0, 0.2, 0.01, 0, 1, -0.01, 0, 1;
  Eigen::MatrixXi F(2, 3);
  F << 0, 1, 2, 3, 4, 5;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  MatrixXd x_new = x * turn.transpose();
  x_new.col(2).array() -= 1;
  CollisionRules rules;
  rules.rigid_bodies = {true};
  TruncateOptions o;
  o.d_hat = 1;
  const TruncatedStep r = truncate_step(Mesh(x, F, rules), x, x_new, o);
  for (const double share : r.share) CHECK((share > 0.05 && share == r.share[0]));
  CHECK_FALSE(has_intersections(Mesh(x, F), matrix(r.positions)));

  x_new(4, 1) = 1e308;
  CHECK(truncate_step(Mesh(x, F), x, x_new, o).outcome == Outcome::out_of_range);
  rules = {};
  rules.static_vertices = {false, false, false, true, false, false};
  x_new = x;
  x_new(3, 2) += 0.1;
  o.d_hat = 1e-17;
  CHECK_THROWS_WITH(truncate_step(Mesh(x, F, rules), x, x_new, o), Catch::Contains("vertex 3 is static"));
}

TEST_CASE("the vertices of a rigid body, and copies that count as one, go together", "[unit]") {
  Drop drop(1, -2, 0);
  CollisionRules rules;
  rules.bodies = {0, 0, 0, 1, 1, 1};
  rules.rigid_bodies = {false, true};
  drop.mesh.set_rules(rules);
  const TruncatedStep r = drop.step();
  CHECK((r.share[3] < 0.5 && r.share[4] == r.share[3] && r.share[5] == r.share[3]));
  CHECK(r.limited_by[5] == 0);

  // Two triangles joined by copies of an edge, one corner of which falls on a third.
  MatrixXd x(9, 3);
  x << 0, 0, 1, 0, 1, 1.5, 1, 1, 2, 0, 0, 1, 0, 1, 1.5, -1, 1, 2, -4, -4, 0, 4, -4, 0, 0, 4, 0;
  MatrixXd x_new = x;
  x_new.col(2).head(6).array() -= 1.25;
  Eigen::MatrixXi F(3, 3);
  F << 0, 1, 2, 3, 5, 4, 6, 7, 8;
  rules = {};
  rules.weld = true;
  const TruncatedStep seam = truncate_step(Mesh(x, F, rules), x, x_new);
  CHECK((seam.outcome == Outcome::contact && seam.share[0] < 1));
  const MatrixXd end = matrix(seam.positions);
  CHECK((end.row(0) == end.row(3) && end.row(1) == end.row(4)));
  CHECK(meets_itself(Mesh(x, F, rules), end).find("face 2") == std::string::npos);
}

TEST_CASE("threads, kernels and broad phases give the same truncated step", "[determinism]") {
  for (const NamedScene& named : some_scenes()) {
    const Mesh mesh = named.mesh();
    TruncateOptions o;
    o.threads = 1;
    const auto ask = [&] {
      const TruncatedStep r = truncate_step(mesh, named.scene.x_t0, named.scene.x_t1, o);
      return Answer().add(r.positions, r.displacements, r.share, r.kept, r.limited_by, r.outcome).hash();
    };
    const auto expected = ask();
    for (InstructionSet kernel : kernels())
      for (int threads : {1, 4})
        for (BroadPhaseMethod method : {BroadPhaseMethod::brute, BroadPhaseMethod::bvh}) {
          o.instruction_set = kernel, o.threads = threads, o.broad_phase = method;
          CAPTURE(named.name, threads, int(kernel), int(method));
          CHECK(ask() == expected);
        }
  }
}

TEST_CASE("in other units, and with its axes exchanged, a scene has the same truncated step", "[property]") {
  for (const NamedScene& named : some_scenes()) {
    const Mesh mesh = named.mesh();
    const MatrixXd &x = named.scene.x_t0, &x_new = named.scene.x_t1;
    const TruncatedStep r = truncate_step(mesh, x, x_new);
    CAPTURE(named.name);
    for (const double unit : {0x1p-60, 0x1p40}) {
      const TruncatedStep there = truncate_step(mesh, unit * x, unit * x_new);
      CHECK((there.share == r.share && matrix(there.positions) == unit * matrix(r.positions)));
    }
    const Eigen::PermutationMatrix<3> turn(Eigen::Vector3i(1, 2, 0));
    const TruncatedStep turned = truncate_step(mesh, x * turn, x_new * turn);
    CHECK((turned.share == r.share && matrix(turned.positions) == matrix(r.positions) * turn));
  }
}

TEST_CASE("more motion is kept than by one step for all", "[property]") {
  for (const NamedScene& named : some_scenes()) {
    const Mesh mesh = named.mesh();
    const TruncatedStep r = truncate_step(mesh, named.scene.x_t0, named.scene.x_t1);
    const LineSearch search(mesh, named.scene.x_t0, named.scene.x_t1 - named.scene.x_t0);
    CAPTURE(named.name, r.kept, search.largest_step().step);
    CHECK(r.kept >= search.largest_step().step);
  }
}

TEST_CASE("budgets and bad positions leave every vertex where it is; bad options throw", "[unit]") {
  Drop drop(1, -2, 0);
  TruncateOptions o;
  o.memory_limit = 50;
  TruncatedStep r = drop.step(o);
  CHECK((r.outcome == Outcome::out_of_memory && r.kept == 0 && matrix(r.positions) == drop.x));
  o = {};
  o.time_limit = 0;
  r = drop.step(o);
  CHECK((r.outcome == Outcome::out_of_time && matrix(r.positions) == drop.x && r.pairs.empty()));
  o = {};
  o.progress = [](double) { return false; };
  CHECK(drop.step(o).outcome == Outcome::cancelled);
  for (const double wrong : {0.0, -1.0, double(NAN)}) {
    o = {};
    o.d_hat = wrong;
    CHECK_THROWS_AS(drop.step(o), std::invalid_argument);
  }
  CHECK_THROWS_AS(drop.step(with_share(1)), std::invalid_argument);
  CHECK_THROWS_AS(truncate_step(drop.mesh, drop.x.topRows(4), drop.x_new), std::invalid_argument);
  drop.x_new(4, 1) = NAN;
  for (const bool ball : {false, true}) {
    o = {};
    if (ball) o.d_hat = 1;
    r = drop.step(o);
    CHECK((r.outcome == Outcome::non_finite && r.vertex == 4 && matrix(r.positions) == drop.x));
  }
}
