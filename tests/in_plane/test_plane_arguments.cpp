// What calls refuse on meshes in the plane, and what they answer for positions that cannot be used.
#include "tests/catch.hpp"
#include "tests/in_plane/support/plane_scenes.hpp"

using namespace onset;
using namespace onset::tests;

namespace {

PlaneScene some() {
  scenes::Random random(3);
  return polygons(3, 0.3, random);
}

template <class F>
std::string refusal(F&& f) {
  try {
    f();
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "";
}

}  // namespace

TEST_CASE("in the plane: three columns for a mesh of two, and the other way, are refused") {
  const PlaneScene s = some();
  const Mesh mesh = s.mesh();
  Eigen::MatrixXd wide = Eigen::MatrixXd::Zero(s.x_t0.rows(), 3);
  wide.leftCols(2) = s.x_t0;
  const std::string needs = "vertices in the plane and needs one row of 2 for each";
  CHECK(refusal([&] { compute_collision_free_stepsize(mesh, wide, wide); }).find(needs) != std::string::npos);
  CHECK(refusal([&] { construct_active_set(mesh, s.x_t0, wide); }).find("x_t1") == 0);
  CHECK(refusal([&] { check(mesh, wide); }).find(needs) != std::string::npos);
  CHECK(refusal([&] { LineSearch(mesh, wide, wide); }).find("one row of 2") != std::string::npos);
  CHECK(refusal([&] { safe_distances(mesh, wide, close_pairs(mesh, s.x_t0, 0.1)); }).find("rows of 2") !=
        std::string::npos);
  CHECK(refusal([&] { mesh.surface_positions(wide); }).find("one row of 2") != std::string::npos);
  const Mesh space(wide, s.edges, Eigen::MatrixXi(0, 3));
  CHECK(space.dimension() == 3);
  CHECK(refusal([&] { close_pairs(space, s.x_t0, 0.1); }).find("one row of 3") != std::string::npos);
  CHECK(refusal([&] {
          compute_collision_free_stepsize(mesh, s.x_t0.transpose(), s.x_t1);
        }).find("x_t0.transpose()") != std::string::npos);
}

TEST_CASE("in the plane: meshes, rules and candidates that do not fit are refused by name") {
  const PlaneScene s = some();
  const Mesh mesh = s.mesh();
  Eigen::MatrixXi faces(1, 3);
  faces << 0, 1, 2;
  CHECK(refusal([&] { Mesh(s.x_t0, s.edges, faces); }).find("has no faces, but 1 are given") !=
        std::string::npos);
  CHECK(refusal([&] { Mesh(s.x_t0, faces); }).find("edges have 3 columns, not 2") == 0);
  CHECK(refusal([&] { Mesh::in_plane(2, s.edges); }).find("edge row") == 0);
  CollisionRules rules;
  rules.excluded_pairs = {{PairKind::edge_edge, 0, 1, {}}};
  CHECK(refusal([&] { s.mesh(rules); }).find("excluded_pairs row 0: kind 1") == 0);
  rules.excluded_pairs = {{PairKind::vertex_edge, 0, int(s.edges.rows()), {}}};
  CHECK(refusal([&] { s.mesh(rules); }).find("excluded_pairs row 0: edge") == 0);
  Candidates c;
  c.edge_edge = {{0, 1}};
  CHECK(refusal([&] { compute_collision_free_stepsize(mesh, c, s.x_t0, s.x_t1); }).find("edge_edge row 0") ==
        0);
  c = {};
  c.vertex_edge = {{0, -1}};
  CHECK(refusal([&] {
          compute_collision_free_stepsize(mesh, c, s.x_t0, s.x_t1);
        }).find("vertex_edge row 0") == 0);
  c.vertex_edge = {{s.edges(0, 0), 0}};
  CHECK(refusal([&] { compute_collision_free_stepsize(mesh, c, s.x_t0, s.x_t1); }).find("share vertex") !=
        std::string::npos);
}

TEST_CASE("in the plane: NaN, infinities and numbers out of range are outcomes") {
  const PlaneScene s = some();
  for (const double bad : {double(NAN), double(INFINITY), 0x1p1021}) {
    Eigen::MatrixXd x = s.x_t1;
    x(4, 1) = bad;
    const StepResult r = compute_collision_free_stepsize(s.mesh(), s.x_t0, x);
    CHECK((r.step == 0 && r.vertex == 4));
    CHECK(r.outcome == (bad == 0x1p1021 ? Outcome::out_of_range : Outcome::non_finite));
    CHECK(construct_active_set(s.mesh(), s.x_t0, x).empty());
    VertexEdgeQuery q{};
    q.t1[0][1] = bad;
    CHECK(vertex_edge_ccd(q).toi == 0);
  }
}

TEST_CASE("in the plane: a mesh of no vertices, or of no edges, is free") {
  const Mesh none = Mesh::in_plane(0, Eigen::MatrixXi(0, 2));
  const Eigen::MatrixXd x(0, 2);
  CHECK(compute_collision_free_stepsize(none, x, x).step == 1);
  Eigen::MatrixXd two(2, 2);
  two << 0, 0, 1, 1;
  const Mesh loose = Mesh::in_plane(2, Eigen::MatrixXi(0, 2));
  CHECK(construct_active_set(loose, two, two.reverse()).empty());
  CHECK(check(loose, two).unused_vertices.size() == 2);
}

TEST_CASE("in the plane: row-major, float and packed positions are the same") {
  const PlaneScene s = some();
  const Mesh mesh = s.mesh();
  const double step = compute_collision_free_stepsize(mesh, s.x_t0, s.x_t1).step;
  const Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> a = s.x_t0, b = s.x_t1;
  CHECK(compute_collision_free_stepsize(mesh, a, b).step == step);
  CHECK(compute_collision_free_stepsize(mesh, Positions(a.data(), a.rows(), 2),
                                        Positions(b.data(), b.rows(), 2))
            .step == step);
  CHECK(compute_collision_free_stepsize(mesh, s.x_t0, s.x_t0 + (s.x_t1 - s.x_t0)).step > 0);
}
