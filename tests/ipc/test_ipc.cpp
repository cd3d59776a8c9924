// The adapter, used as code written for ipc-toolkit uses it: only the include and the namespace differ.
#include <onset/compat/ipc.hpp>

#include "tests/catch.hpp"
#include "tests/fuzz.hpp"
#include "tests/oracle/oracle.hpp"
#include "tests/scenes/meshes.hpp"
#include "tests/src/support/mesh_pairs.hpp"

namespace ipc = onset::ipc;
using Eigen::MatrixXd;
using Eigen::MatrixXi;

namespace {

// A contact form as line searches have it: candidates once a direction, then steps from them.
class ContactForm {
 public:
  ContactForm(const ipc::CollisionMesh& mesh, double dhat) : mesh_(mesh), dhat_(dhat) {}
  void line_search_begin(const MatrixXd& V0, const MatrixXd& V1) {
    candidates_.build(mesh_, V0, V1, /*inflation_radius=*/dhat_ / 2, broad_phase_);
  }
  double max_step_size(const MatrixXd& V0, const MatrixXd& V1) const {
    return candidates_.compute_collision_free_stepsize(mesh_, V0, V1, dmin_, tight_inclusion_ccd_);
  }
  bool is_step_collision_free(const MatrixXd& V0, const MatrixXd& V1) const {
    return candidates_.is_step_collision_free(mesh_, V0, V1, dmin_, tight_inclusion_ccd_);
  }
  std::size_t size() const { return candidates_.size(); }

 private:
  const ipc::CollisionMesh& mesh_;
  ipc::Candidates candidates_;
  ipc::BroadPhase* broad_phase_ = nullptr;
  ipc::TightInclusionCCD tight_inclusion_ccd_{1e-6, 10000, 0.8};
  double dhat_, dmin_ = 0;
};

// The smallest double that is certainly no earlier than the first contact of any pair that shares no vertex
// and that may collide.
double exact_first_contact(const ipc::CollisionMesh& mesh, const MatrixXd& V0, const MatrixXd& V1) {
  double earliest = INFINITY;
  onset::tests::for_all_pairs(
      mesh.onset_mesh(), [&](onset::PairKind kind, int, int, const std::array<int, 4>& v) {
        const int first = onset::scenes::first_body(kind);
        bool may = mesh.can_collide.accepts_all();
        for (int i = 0; i < first; ++i)
          for (int j = first; j < 4; ++j) may = may || mesh.can_collide(v[i], v[j]);
        if (!may) return;
        const auto truth = onset::oracle::exact_ccd(onset::tests::query_of(kind, v, V0, V1));
        if (truth.collides) earliest = std::min(earliest, truth.toi_hi);
      });
  return earliest;
}

}  // namespace

TEST_CASE("steps of the adapter are never later than the exact first contact", "[oracle][property]") {
  const int seeds = std::max(4, onset::tests::fuzz(12));
  int contacts = 0, filtered_contacts = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    onset::scenes::Random random{unsigned(seed)};
    const auto soup = onset::scenes::triangle_soup(16, 0.3, seed % 4 == 0 ? 0.02 : 0.3, random);
    const MatrixXd V0 = soup.x_t0, V1 = soup.x_t1;
    ipc::CollisionMesh mesh(V0, onset::edges(soup.faces), soup.faces);
    for (const bool filtered : {false, true}) {
      if (filtered)
        mesh.can_collide = [](std::size_t i, std::size_t j) {
          return i / 12 != j / 12;
        };  // between four parts
      const double exact = exact_first_contact(mesh, V0, V1);
      const double step = ipc::compute_collision_free_stepsize(mesh, V0, V1);
      ContactForm form(mesh, 1e-3);
      form.line_search_begin(V0, V1);
      CAPTURE(seed, filtered, exact, step, form.size());
      CHECK(step <= exact);
      CHECK(form.max_step_size(V0, V1) <= exact);
      const bool free = ipc::is_step_collision_free(mesh, V0, V1);
      CHECK((!free || exact == INFINITY));
      CHECK(form.is_step_collision_free(V0, V1) == free);
      if (exact == INFINITY) CHECK(free);
      contacts += exact < INFINITY, filtered_contacts += filtered && exact < INFINITY;
      // A fifth of each gap is kept, also by pairs that pass without contact: no share of exact is promised.
      if (exact < INFINITY && exact > 0) CHECK(step > 0.05 * exact);
    }
  }
  CHECK((contacts > seeds / 2 && filtered_contacts > 0));
}

TEST_CASE("vertices of no edge or face collide with edges and each other", "[oracle][property]") {
  int contacts = 0, of_points = 0;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    onset::scenes::Random random(seed);
    const auto soup = onset::scenes::triangle_soup(2, 0.5, 0.1, random);
    MatrixXd V0(18, 3), V1(18, 3);  // two triangles, a wire and ten points on a small grid
    V0.topRows(6) = soup.x_t0, V1.topRows(6) = soup.x_t1;
    for (int v = 6; v < 18; ++v)
      for (int a = 0; a < 3; ++a) V0(v, a) = onset::scenes::integer(random, -2, 2);
    V1.bottomRows(12) = -V0.bottomRows(12);  // all through one place
    V1.bottomRows(seed).array() += 0.125;
    MatrixXi edges(7, 2);
    edges << onset::edges(soup.faces), 6, 7;
    const ipc::CollisionMesh mesh(V0, edges, soup.faces);
    REQUIRE((mesh.num_edges() == 7 && mesh.num_codim_vertices() == 10 && mesh.codim_vertices()[0] == 8));
    const double exact = exact_first_contact(mesh, V0, V1);
    if (exact == 0) continue;  // some begin in one place: a step that parts them goes on
    const double step = ipc::compute_collision_free_stepsize(mesh, V0, V1);
    ContactForm form(mesh, 1e-3);
    form.line_search_begin(V0, V1);
    ipc::Candidates candidates;
    candidates.build(mesh, V0, V1);
    of_points += !candidates.vv_candidates.empty() && !candidates.ev_candidates.empty();
    CAPTURE(seed, exact, step);
    CHECK((step <= exact && form.max_step_size(V0, V1) <= exact));
    if (exact < INFINITY) CHECK_FALSE(form.is_step_collision_free(V0, V1));
    if (exact < INFINITY) CHECK(step > 0.05 * exact);
    contacts += exact < INFINITY;
    candidates.vv_candidates.push_back({0, 8});
    CHECK_THROWS_AS(candidates.is_step_collision_free(mesh, V0, V1), std::invalid_argument);
  }
  CHECK((contacts > 4 && of_points > 4));
}

TEST_CASE("candidates of positions are those of a motion that stays there", "[unit]") {
  MatrixXd x(8, 3);
  x << 0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, 0.5, 2, 1, 0.5, 1, 2, 0.5, 1, 1, 9, 3, 3, 9;
  const MatrixXi faces = (MatrixXi(2, 3) << 0, 1, 2, 3, 4, 5).finished();
  const ipc::CollisionMesh mesh(x, {}, faces);
  ipc::Candidates still, moving;
  CHECK(still.empty());
  still.build(mesh, x, 0.125);
  CHECK(still.empty());
  still.build(mesh, x, 1);
  moving.build(mesh, x, x, 1);
  CHECK((!still.empty() && still.size() == moving.size()));
  CHECK(still.fv_candidates.size() == moving.fv_candidates.size());

  // A vertex between those of no edge and no face, and one after them.
  for (const int vertex : {2, 8}) {
    still.clear();
    still.vv_candidates = {{6, vertex}};
    CHECK_THROWS_WITH(still.compute_collision_free_stepsize(mesh, x, x),
                      Catch::Contains("vertex " + std::to_string(vertex)));
  }
}

TEST_CASE("planes keep vertices out of every call of the adapter", "[unit]") {
  onset::scenes::Scene s = onset::scenes::cloth(3, 3);
  onset::scenes::displace(s, {0, 0, -2});
  ipc::CollisionMesh mesh(s.x_t0, MatrixXi(), s.faces);
  mesh.set_planes({{{0, 0, 2}, -2}});
  for (const bool filtered : {false, true}) {
    if (filtered) mesh.can_collide = [](std::size_t, std::size_t) { return true; };
    const double step = ipc::compute_collision_free_stepsize(mesh, s.x_t0, s.x_t1);
    CHECK((step > 0.399 && step <= 0.4));
    CHECK(!ipc::is_step_collision_free(mesh, s.x_t0, s.x_t1));
    CHECK(!ipc::has_intersections(mesh, s.x_t0));
    CHECK(ipc::has_intersections(mesh, s.x_t1));
  }
  ipc::Candidates candidates;
  candidates.build(mesh, s.x_t0, s.x_t1);
  REQUIRE(candidates.pv_candidates.size() == 9);
  CHECK((candidates.pv_candidates[4].plane.coeffs() == mesh.planes[0].coeffs() &&
         candidates.pv_candidates[4].vertex_id == 4));
  CHECK(candidates.compute_collision_free_stepsize(mesh, s.x_t0, s.x_t1) <= 0.4);
}

TEST_CASE("what is not finite has no candidates and no step", "[unit]") {
  const MatrixXd x = MatrixXd::Random(6, 3);
  const MatrixXi faces = (MatrixXi(2, 3) << 0, 1, 2, 3, 4, 5).finished();
  ipc::CollisionMesh mesh(x, onset::edges(faces), faces);
  for (const double bad : {double(NAN), double(INFINITY)})
    for (const bool filtered : {false, true})
      for (const bool at_start : {false, true}) {
        CAPTURE(bad, filtered, at_start);
        mesh.can_collide = nullptr;
        if (filtered) mesh.can_collide = [](std::size_t, std::size_t) { return true; };
        MatrixXd other = x;
        other(4, 1) = bad;
        const MatrixXd &V0 = at_start ? other : x, &V1 = at_start ? x : other;
        ipc::Candidates candidates;
        CHECK_THROWS_WITH(candidates.build(mesh, V0, V1), "Candidates::build: non_finite");
        CHECK(ipc::compute_collision_free_stepsize(mesh, V0, V1) == 0);
        CHECK_FALSE(ipc::is_step_collision_free(mesh, V0, V1));
      }
}

TEST_CASE("a surface of a full mesh takes its vertices and gives its dofs back", "[unit]") {
  // Vertices 1, 3, 4 and 0 of five are on the surface.
  MatrixXd full(5, 3);
  full << 0, 0, 0, 1, 0, 0, 9, 9, 9, 0, 1, 0, 0, 0, 1;
  MatrixXi edges(0, 2), faces(2, 3);
  faces << 1, 3, 4, 0, 3, 1;
  const ipc::CollisionMesh mesh = ipc::CollisionMesh::build_from_full_mesh(full, edges, faces);
  CHECK((mesh.num_vertices() == 4 && mesh.num_edges() == 5 && mesh.full_num_vertices() == 5));
  CHECK((mesh.num_faces() == 2 && mesh.ndof() == 12 && mesh.dim() == 3));
  CHECK((mesh.to_full_vertex_id(0) == 0 && mesh.to_full_vertex_id(2) == 3 && mesh.to_full_vertex_id(3) == 4));
  CHECK(mesh.vertices(full) == mesh.rest_positions());
  CHECK(mesh.displace_vertices(full) == 2 * mesh.rest_positions());
  CHECK_THROWS_AS(mesh.vertices(mesh.rest_positions()), std::invalid_argument);
  CHECK_THROWS_AS(mesh.vertices(MatrixXd::Zero(5, 2)), std::invalid_argument);
  for (const int wrong : {-1, 5}) {
    faces(1, 1) = wrong;
    CHECK_THROWS_WITH(ipc::CollisionMesh::build_from_full_mesh(full, edges, faces),
                      "vertex " + std::to_string(wrong) + " is out of range, the full mesh has 5");
  }

  const Eigen::VectorXd gradient = Eigen::VectorXd::LinSpaced(12, 1, 12);
  const Eigen::VectorXd in_full = mesh.to_full_dof(gradient);
  REQUIRE(in_full.size() == 15);
  CHECK((in_full.segment<3>(6).isZero() && in_full.segment<3>(9) == gradient.segment<3>(6)));
  Eigen::SparseMatrix<double> hessian(12, 12);
  hessian.insert(11, 0) = 5;
  CHECK(mesh.to_full_dof(hessian).coeff(14, 0) == 5);

  // The same by a displacement map, of vertices or of dofs.
  for (const int dim : {1, 3}) {
    Eigen::SparseMatrix<double> map(4 * dim, 5 * dim);
    for (int v = 0; v < 4; ++v)
      for (int a = 0; a < dim; ++a) map.insert(dim * v + a, dim * mesh.to_full_vertex_id(v) + a) = 1;
    const ipc::CollisionMesh mapped(mesh.rest_positions(), mesh.edges(), mesh.faces(), map);
    CHECK(mapped.full_ndof() == 15);
    CHECK(mapped.displace_vertices(full) == mesh.displace_vertices(full));
    // Positions go through the map as displacements from rest.
    const MatrixXd moved = MatrixXd::Random(4, 3);
    const ipc::CollisionMesh scaled(
        mesh.rest_positions(), mesh.edges(), mesh.faces(),
        Eigen::SparseMatrix<double>(2 * MatrixXd::Identity(4 * dim, 4 * dim).sparseView()));
    CHECK(scaled.vertices(moved) == mesh.rest_positions() + 2 * MatrixXd(moved - mesh.rest_positions()));
    CHECK(mapped.to_full_dof(gradient) == in_full);
  }
}

TEST_CASE("maps and values whose shapes do not fit are refused by both numbers", "[unit]") {
  const MatrixXd x = MatrixXd::Random(9, 3);
  const MatrixXi faces = (MatrixXi(3, 3) << 0, 1, 2, 3, 4, 5, 6, 7, 8).finished();
  const auto mesh_of = [&](Eigen::Index rows, Eigen::Index cols) {
    Eigen::SparseMatrix<double> map(rows, cols);
    map.insert(0, 0) = 1, map.insert(rows - 1, cols - 1) = 2;
    return ipc::CollisionMesh(x, {}, faces, map);
  };
  for (const auto& [rows, cols] :
       {std::pair(6, 30), {1, 9}, {10, 9}, {26, 27}, {28, 27}, {18, 18}, {27, 28}, {27, 2}})
    CHECK_THROWS_WITH(mesh_of(rows, cols), Catch::Contains("displacement_map is " + std::to_string(rows) +
                                                           " x " + std::to_string(cols)) &&
                                               Catch::Contains("9 vertices"));
  // Ten vertices have displacements, and no positions at rest that are known here.
  for (const int dim : {1, 3}) {
    const ipc::CollisionMesh mesh = mesh_of(9 * dim, 10 * dim);
    CHECK((mesh.full_num_vertices() == 10 && mesh.full_ndof() == 30));
    const MatrixXd moved = mesh.displace_vertices(MatrixXd::Ones(10, 3));
    CHECK((moved.row(1) == x.row(1) && moved(0, 0) == x(0, 0) + 1 && moved(8, 2) == x(8, 2) + 2));
    CHECK(mesh.to_full_dof(Eigen::VectorXd::Ones(27)).size() == 30);
    for (const int rows : {9, 10})
      CHECK_THROWS_WITH(mesh.vertices(MatrixXd::Zero(rows, 3)),
                        Catch::Contains("from 10 vertices") && Catch::Contains("displace_vertices"));
    for (const int rows : {0, 9, 11, 30})
      CHECK_THROWS_WITH(mesh.displace_vertices(MatrixXd::Zero(rows, 3)),
                        Catch::Contains(std::to_string(rows) + " x 3") && Catch::Contains("10 vertices"));
    CHECK_THROWS_AS(mesh.map_displacements(MatrixXd::Zero(10, 2)), std::invalid_argument);
  }
  const ipc::CollisionMesh mesh(x, {}, faces), square = mesh_of(9, 9);
  for (const ipc::CollisionMesh* m : {&mesh, &square}) {
    CHECK(m->vertices(x) == x);
    for (const int n : {0, 9, 26, 28})
      CHECK_THROWS_WITH(m->to_full_dof(Eigen::VectorXd::Zero(n)),
                        Catch::Contains(std::to_string(n)) && Catch::Contains("27 degrees of freedom"));
    for (const auto& [rows, cols] : {std::pair(27, 26), {26, 27}, {9, 9}})
      CHECK_THROWS_WITH(m->to_full_dof(Eigen::SparseMatrix<double>(rows, cols)),
                        Catch::Contains(std::to_string(rows) + " x " + std::to_string(cols)) &&
                            Catch::Contains("27 degrees of freedom"));
  }
}

TEST_CASE("positions of the wrong shape are refused before they are read", "[unit]") {
  const MatrixXi faces = (MatrixXi(2, 3) << 0, 1, 2, 3, 4, 5).finished();
  const MatrixXd x = MatrixXd::Random(6, 3);
  ipc::CollisionMesh mesh(x, {}, faces);
  for (const bool filtered : {false, true}) {
    if (filtered) mesh.can_collide = [](std::size_t, std::size_t) { return true; };
    for (const auto& [rows, cols] : {std::pair(0, 3), {5, 3}, {7, 3}, {6000, 3}, {6, 2}, {6, 4}, {9, 2}}) {
      CAPTURE(filtered, rows, cols);
      const MatrixXd other = MatrixXd::Zero(rows, cols);
      CHECK_THROWS_AS(ipc::compute_collision_free_stepsize(mesh, x, other), std::invalid_argument);
      CHECK_THROWS_AS(ipc::compute_collision_free_stepsize(mesh, other, x), std::invalid_argument);
      CHECK_THROWS_AS(ipc::is_step_collision_free(mesh, x, other), std::invalid_argument);
      CHECK_THROWS_AS(ipc::is_step_collision_free(mesh, other, x), std::invalid_argument);
      CHECK_THROWS_AS(ipc::has_intersections(mesh, other), std::invalid_argument);
    }
  }
}

TEST_CASE("edges that lack one of a face are refused by the ids that were passed", "[unit]") {
  const MatrixXd x = MatrixXd::Random(5, 3);
  const MatrixXi faces = Eigen::RowVector3i(1, 2, 4), wire = Eigen::RowVector2i(1, 2);
  CHECK_THROWS_WITH(ipc::CollisionMesh(x, wire, faces),
                    Catch::Contains("face row 0") && Catch::Contains("vertices 2 and 4"));
  CHECK_THROWS_WITH(ipc::CollisionMesh::build_from_full_mesh(x, wire, faces),
                    Catch::Contains("face row 0") && Catch::Contains("vertices 2 and 4"));
  const auto mesh = ipc::CollisionMesh::build_from_full_mesh(x, onset::complete_edges(wire, faces), faces);
  CHECK((mesh.num_edges() == 3 && mesh.num_vertices() == 3));
}

TEST_CASE("intersections are seen as ipc-toolkit's call of that name does, less what cannot collide",
          "[unit]") {
  MatrixXd x(6, 3);
  x << 0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, -1, 1, 1, 1, 1, 5, 1;
  const MatrixXi faces = (MatrixXi(2, 3) << 0, 1, 2, 3, 4, 5).finished();
  ipc::CollisionMesh mesh(x, onset::edges(faces), faces);
  CHECK(ipc::has_intersections(mesh, x));
  mesh.can_collide = [](std::size_t i, std::size_t j) { return i / 3 == j / 3; };
  CHECK_FALSE(ipc::has_intersections(mesh, x));
  mesh.can_collide = [](std::size_t i, std::size_t j) { return i + j == 3 || i + j == 4; };
  CHECK(ipc::has_intersections(mesh, x));
  x.bottomRows(3).array() += 9;
  CHECK_FALSE(ipc::has_intersections(mesh, x));
  x(0, 0) = NAN;
  CHECK(ipc::has_intersections(mesh, x));
}

TEST_CASE("listed pairs are checked", "[unit]") {
  MatrixXi faces(2, 3);
  faces << 0, 1, 2, 3, 4, 5;
  const MatrixXd x = MatrixXd::Random(6, 3);
  const onset::Mesh mesh(x, faces);
  onset::Candidates c;
  c.vertex_face = {{3, 0}};
  c.edge_edge = {{3, 0}};  // in either order
  CHECK(onset::compute_collision_free_stepsize(mesh, c, x, x).step == 1);
  for (const auto& wrong : {std::array<int, 2>{6, 0}, {-1, 0}, {3, 2}, {3, -1}}) {
    c.vertex_face = {{3, 0}, wrong};
    CHECK_THROWS_WITH(onset::compute_collision_free_stepsize(mesh, c, x, x),
                      Catch::Contains("vertex_face row 1: the mesh has no pair " + std::to_string(wrong[0])));
  }
  c.vertex_face = {{0, 0}};
  CHECK_THROWS_AS(onset::compute_collision_free_stepsize(mesh, c, x, x), std::invalid_argument);
  c.vertex_face = {};
  for (const auto& wrong : {std::array<int, 2>{0, 1}, {0, 2}, {1, 2}}) {
    c.edge_edge = {wrong};
    CHECK_THROWS_WITH(onset::compute_collision_free_stepsize(mesh, c, x, x),
                      Catch::Contains("edge_edge row 0: the two share vertex"));
  }
  CHECK_THROWS_AS(onset::compute_collision_free_stepsize(mesh, {}, x, x, {}, 1), std::invalid_argument);
}
