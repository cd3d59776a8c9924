// CollisionMesh by ipc-toolkit's names: how it is made, what it says of its topology, and which matrices it
// takes.
#include <onset/compat/ipc.hpp>
#include <thread>

#include "tests/catch.hpp"
#include "tests/scenes/meshes.hpp"

namespace ipc = onset::ipc;
using Eigen::MatrixXd;
using Eigen::MatrixXi;

namespace {

using Lists = std::vector<std::vector<ipc::index_t>>;

// Two triangles with a common edge, a wire at one of their corners, and two points.
struct Mixed {
  MatrixXd x = MatrixXd::Random(8, 3);
  MatrixXi faces = (MatrixXi(2, 3) << 0, 1, 2, 2, 1, 4).finished();
  MatrixXi edges =
      (MatrixXi(6, 2) << 4, 6, 1, 0, 1, 2, 2, 0, 1, 4, 4, 2).finished();  // 3, 5 and 7 are in none
};

bool equal(const Eigen::VectorXi& a, const std::vector<int>& b) {
  return std::vector<int>(a.data(), a.data() + a.size()) == b;
}

}  // namespace

TEST_CASE("a mesh of no vertices is there to be assigned to", "[unit]") {
  ipc::CollisionMesh mesh;
  CHECK((mesh.num_vertices() == 0 && mesh.num_edges() == 0 && mesh.num_faces() == 0 && mesh.ndof() == 0));
  CHECK((mesh.num_codim_vertices() == 0 && mesh.full_num_vertices() == 0 && mesh.can_collide.accepts_all()));
  const Mixed m;
  mesh = ipc::CollisionMesh(m.x, m.edges, m.faces);
  CHECK((mesh.num_vertices() == 8 && mesh.dim() == 3 && mesh.are_adjacencies_initialized()));
  const ipc::CollisionMesh copy = mesh, moved = std::move(mesh);
  for (const ipc::CollisionMesh* other : {&copy, &moved})
    CHECK((other->num_codim_vertices() == 3 && ipc::compute_collision_free_stepsize(*other, m.x, m.x) == 1));
}

TEST_CASE("a mesh knows what lies at its vertices, edges and faces", "[unit]") {
  const Mixed m;
  ipc::CollisionMesh mesh(m.x, m.edges, m.faces);
  mesh.init_adjacencies();
  CHECK((equal(mesh.codim_vertices(), {3, 5, 7}) && equal(mesh.codim_edges(), {0})));
  CHECK((mesh.is_codim_vertex(3) && !mesh.is_codim_vertex(6) && mesh.is_codim_edge(0) &&
         !mesh.is_codim_edge(1)));
  CHECK((mesh.num_codim_edges() == 1 && !mesh.is_orient_vertex(0)));
  CHECK(mesh.faces_to_edges() == (MatrixXi(2, 3) << 1, 2, 3, 2, 4, 5).finished());
  CHECK(mesh.faces_to_edges() == ipc::CollisionMesh::construct_faces_to_edges(m.faces, m.edges));
  CHECK(mesh.edges_to_faces() == Lists{{}, {0}, {0, 1}, {0}, {1}, {1}});
  CHECK(mesh.vertices_to_edges() == Lists{{1, 3}, {1, 2, 4}, {2, 3, 5}, {}, {0, 4, 5}, {}, {0}, {}});
  CHECK(mesh.vertices_to_faces() == Lists{{0}, {0, 1}, {0, 1}, {}, {1}, {}, {}, {}});
  CHECK(mesh.vertex_vertex_adjacencies() == Lists{{1, 2}, {0, 2, 4}, {0, 1, 4}, {}, {1, 2, 6}, {}, {4}, {}});
  CHECK(mesh.vertex_edge_adjacencies() == mesh.vertices_to_edges());
  CHECK(mesh.vertex_face_adjacencies() == mesh.vertices_to_faces());
  CHECK(mesh.edge_vertex_adjacencies() == Lists{{}, {2}, {0, 4}, {1}, {2}, {1}});
  CHECK(mesh.edge_length(0) == (m.x.row(4) - m.x.row(6)).norm());
  double longest = 0;
  for (int e = 0; e < 6; ++e) longest = std::max(longest, mesh.edge_length(e));
  CHECK(mesh.max_edge_length() == longest);
  const MatrixXi fewer = m.edges.topRows(5);
  CHECK_THROWS_AS(ipc::CollisionMesh::construct_faces_to_edges(m.faces, fewer), std::runtime_error);
  CHECK_THROWS_AS(mesh.to_full_vertex_id(8), std::out_of_range);
}

TEST_CASE("a surface of the full mesh is made without faces, and of vertices that are named", "[unit]") {
  const Mixed m;
  const auto wires = ipc::CollisionMesh::build_from_full_mesh(m.x, m.edges.topRows(1));
  CHECK((wires.num_vertices() == 2 && wires.num_faces() == 0 && wires.num_codim_edges() == 1));
  CHECK(equal(wires.to_full_vertex_id(), {4, 6}));

  const std::vector<bool> on_surface =
      ipc::CollisionMesh::construct_is_on_surface(8, m.edges, (Eigen::VectorXi(1) << 7).finished());
  CHECK(on_surface == std::vector<bool>{true, true, true, false, true, false, true, true});
  std::vector<bool> orient(8);
  orient[4] = true;
  const ipc::CollisionMesh mesh(on_surface, orient, m.x, m.edges, m.faces);
  CHECK((mesh.num_vertices() == 6 && mesh.full_num_vertices() == 8 && equal(mesh.codim_vertices(), {5})));
  CHECK((mesh.to_full_vertex_id(5) == 7 && mesh.is_orient_vertex(3) && !mesh.is_orient_vertex(4)));
  CHECK(mesh.faces().row(1) == Eigen::RowVector3i(2, 1, 3));
  CHECK((mesh.rest_positions().row(3) == m.x.row(4) && mesh.vertices(m.x) == mesh.rest_positions()));
  std::vector<bool> without = on_surface;
  without[6] = false;
  CHECK_THROWS_WITH(ipc::CollisionMesh(without, orient, m.x, m.edges, m.faces),
                    Catch::Contains("vertex 6") && Catch::Contains("not included"));
  CHECK_THROWS_AS(ipc::CollisionMesh(std::vector<bool>(7), {}, m.x), std::invalid_argument);
  for (const int columns : {1, 4, 6})
    CHECK_THROWS_WITH(ipc::CollisionMesh(MatrixXd::Zero(8, columns), m.edges, m.faces),
                      Catch::Contains("8 x " + std::to_string(columns)));

  // A map gives displacements of the full mesh; the rows of the surface are used.
  Eigen::SparseMatrix<double> map(8, 3);
  for (int v = 0; v < 8; ++v) map.insert(v, v % 3) = v + 1;
  const MatrixXd moved = MatrixXd::Random(3, 3);
  const ipc::CollisionMesh mapped(on_surface, {}, m.x, m.edges, m.faces, map);
  const MatrixXd expected = map * moved, got = mapped.map_displacements(moved);
  for (int v = 0; v < 6; ++v) CHECK(got.row(v) == expected.row(mapped.to_full_vertex_id(v)));
  CHECK(ipc::CollisionMesh::vertex_matrix_to_dof_matrix(map, 3).coeff(7, 4) == 0);
  CHECK(ipc::CollisionMesh::vertex_matrix_to_dof_matrix(map, 3).coeff(4 * 3 + 2, 1 * 3 + 2) == 5);
}

TEST_CASE("all matrices are taken: of float, by rows, blocks, expressions", "[unit]") {
  auto s = onset::scenes::sphere_onto_cube(6, 8, 0.25, 0.5);
  s.x_t0 = s.x_t0.cast<float>().cast<double>(), s.x_t1 = s.x_t1.cast<float>().cast<double>();
  const ipc::CollisionMesh mesh(s.x_t0, onset::edges(s.faces), s.faces);
  const double step = ipc::compute_collision_free_stepsize(mesh, s.x_t0, s.x_t1);
  CHECK((step > 0.3 && step < 0.5));
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
  using LongIds = Eigen::Matrix<std::int64_t, Eigen::Dynamic, 3, Eigen::RowMajor>;
  const Rows by_rows = s.x_t0;
  MatrixXd wide(s.x_t0.rows(), 5);
  wide.middleCols(1, 3) = s.x_t0;
  const MatrixXd dx = s.x_t1 - s.x_t0;
  const auto same = [&](const auto& start) {
    const ipc::CollisionMesh other(start, onset::edges(s.faces), LongIds(s.faces.cast<std::int64_t>()));
    CHECK(other.rest_positions() == mesh.rest_positions());
    CHECK((other.faces() == mesh.faces() && other.vertices(start) == s.x_t0));
    CHECK(ipc::compute_collision_free_stepsize(other, start, s.x_t0 + dx) == step);
    CHECK(ipc::compute_collision_free_stepsize(other, s.x_t0, s.x_t1.cast<float>()) == step);
    CHECK_FALSE(ipc::is_step_collision_free(other, start, Rows(s.x_t1)));
    CHECK_FALSE(ipc::has_intersections(other, start));
    ipc::Candidates listed, expected;
    listed.build(other, start, Rows(s.x_t1)), expected.build(mesh, s.x_t0, s.x_t1);
    CHECK((listed.size() == expected.size() && listed.size() > 0));
    CHECK(listed.compute_collision_free_stepsize(other, start, s.x_t1) == step);
  };
  same(s.x_t0), same(by_rows), same(wide.middleCols(1, 3)), same(Eigen::MatrixXf(s.x_t0.cast<float>()));
  same(Eigen::Map<const Rows>(by_rows.data(), by_rows.rows(), 3)), same(Eigen::Ref<const MatrixXd>(s.x_t0));
  LongIds beyond = s.faces.cast<std::int64_t>();
  beyond(2, 1) += std::int64_t(1) << 32;  // the same int
  CHECK_THROWS_WITH(ipc::CollisionMesh(s.x_t0, onset::edges(s.faces), beyond),
                    Catch::Contains("row 2") && Catch::Contains("range of int"));
}

TEST_CASE("planes of Eigen's kind keep vertices out, as they are at each call", "[unit]") {
  onset::scenes::Scene s = onset::scenes::cloth(3, 3);
  onset::scenes::displace(s, {0, 0, -2});
  ipc::CollisionMesh mesh(s.x_t0, MatrixXi(), s.faces);
  CHECK(ipc::compute_collision_free_stepsize(mesh, s.x_t0, s.x_t1) == 1);
  mesh.planes.emplace_back(Eigen::Vector3d(0, 0, 1), 1.0);  // z > -1
  const ipc::CollisionMesh copy = mesh;
  mesh.planes.emplace_back(Eigen::Vector3d(0, 0, 2), Eigen::Vector3d(5, 5, -0.5));  // z > -1/2
  const auto step = [&](const ipc::CollisionMesh& m) {
    return ipc::compute_collision_free_stepsize(m, s.x_t0, s.x_t1);
  };
  CHECK((step(copy) <= 0.4 && step(copy) > 0.399 && step(mesh) <= 0.2 && step(mesh) > 0.199));
  ipc::Candidates candidates;
  candidates.build(mesh, s.x_t0, s.x_t1);
  REQUIRE(candidates.pv_candidates.size() == 18);
  const std::size_t others = candidates.size() - 18;
  CHECK((candidates.is_plane_vertex(others) && (others == 0 || !candidates.is_plane_vertex(others - 1))));
  for (std::size_t i = 0; i < 18; ++i) {
    const auto& c = candidates[others + i].as<ipc::PlaneVertexCandidate>();
    CHECK((c.vertex_id == ipc::index_t(i / 2) && c == candidates.pv_candidates[i]));
    CHECK(std::fabs(c.compute_distance(s.x_t0, mesh.edges(), mesh.faces()) - (i % 2 == 0 ? 1 : 0.25)) <
          1e-14);
    double toi = -1;
    CHECK(c.ccd(c.dof(s.x_t0, mesh.edges(), mesh.faces()), c.dof(s.x_t1, mesh.edges(), mesh.faces()), toi));
    CHECK((toi <= (i % 2 == 0 ? 0.4 : 0.2) && toi > 0.19));
  }
  CHECK(candidates.compute_collision_free_stepsize(mesh, s.x_t0, s.x_t1) <= 0.2);
  CHECK_THROWS_WITH(candidates.compute_collision_free_stepsize(copy, s.x_t0, s.x_t1),
                    "the plane of a candidate is none of the mesh's planes");
  CHECK(ipc::has_intersections(mesh, s.x_t1));
  mesh.planes.clear();
  CHECK((step(mesh) == 1 && !ipc::has_intersections(mesh, s.x_t1)));
  mesh.planes.emplace_back(Eigen::Vector3d(0, 0, NAN), 0.0);
  CHECK_THROWS_AS(step(mesh), std::invalid_argument);

  // Asked from several threads before any has set them.
  ipc::CollisionMesh shared(s.x_t0, MatrixXi(), s.faces);
  shared.planes = copy.planes;
  std::vector<double> steps(4);
  std::vector<std::thread> threads;
  for (double& r : steps) threads.emplace_back([&] { r = step(shared); });
  for (std::thread& t : threads) t.join();
  CHECK(steps == std::vector<double>(4, step(copy)));
}

TEST_CASE("planes, points and maps have their place in two dimensions", "[unit]") {
  // A polyline above the line y = 0, and a point beside it.
  const MatrixXd x = (MatrixXd(4, 2) << 0, 1, 1, 1, 2, 1, 3, 2).finished();
  const MatrixXi edges = (MatrixXi(2, 2) << 0, 1, 1, 2).finished();
  ipc::CollisionMesh mesh(x, edges);
  CHECK((mesh.dim() == 2 && mesh.ndof() == 8 && equal(mesh.codim_vertices(), {3})));
  CHECK((mesh.num_codim_edges() == 2 && mesh.full_ndof() == 8));
  MatrixXd moved = x;
  moved.col(1).array() -= 2;
  mesh.planes.emplace_back(Eigen::Vector3d(0, 1, 0), 0.0);
  const double step = ipc::compute_collision_free_stepsize(mesh, x, moved);
  CHECK((step <= 0.4 && step > 0.399));
  ipc::Candidates candidates;
  candidates.build(mesh, x, moved);
  CHECK(candidates.pv_candidates.size() == 4);
  double toi = -1;
  const auto& first = candidates.pv_candidates[0];
  CHECK(first.ccd(first.dof(x, edges, {}), first.dof(moved, edges, {}), toi));
  CHECK((toi <= 0.4 && toi > 0.399 && first.compute_distance(x, edges, {}) == 1));
  const auto part = ipc::CollisionMesh::build_from_full_mesh(x, edges.bottomRows(1));
  CHECK((part.num_vertices() == 2 && part.dim() == 2 && equal(part.to_full_vertex_id(), {1, 2})));
}
