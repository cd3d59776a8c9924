// Candidates by ipc-toolkit's names: their order, what each can be asked, and steps from them.
#include <onset/compat/ipc.hpp>

#include "tests/catch.hpp"
#include "tests/fuzz.hpp"
#include "tests/oracle/arithmetic/rational.hpp"
#include "tests/oracle/within.hpp"
#include "tests/scenes/meshes.hpp"
#include "tests/src/support/mesh_pairs.hpp"

namespace ipc = onset::ipc;
using Eigen::MatrixXd;
using Eigen::MatrixXi;
using onset::oracle::Rational;

namespace {

// Triangles, a wire and points, all within reach of each other.
struct Mixed {
  MatrixXd x0, x1;
  MatrixXi edges, faces;
  explicit Mixed(unsigned seed, double speed = 0.2) {
    onset::scenes::Random random(seed);
    const auto soup = onset::scenes::triangle_soup(4, 0.8, speed, random);
    const Eigen::Index n = soup.x_t0.rows();
    x0 = MatrixXd(n + 5, 3);
    x0.topRows(n) = soup.x_t0;
    for (Eigen::Index v = n; v < n + 5; ++v)
      for (int a = 0; a < 3; ++a) x0(v, a) = onset::scenes::uniform(random, -0.7, 0.7);
    x1 = x0;
    x1.topRows(n) = soup.x_t1;
    for (Eigen::Index v = n; v < n + 5; ++v)
      for (int a = 0; a < 3; ++a) x1(v, a) += onset::scenes::uniform(random, -speed, speed);
    edges = MatrixXi(13, 2);
    edges << onset::edges(soup.faces), int(n), int(n + 1);
    faces = soup.faces;
  }
  ipc::CollisionMesh mesh() const { return ipc::CollisionMesh(x0, edges, faces); }
};

// The query of the oracle for a candidate: points are edges of length zero.
onset::scenes::Query query_of(const ipc::CollisionStencil& c, const ipc::CollisionMesh& mesh,
                              const MatrixXd& x0, const MatrixXd& x1) {
  const auto v = c.vertex_ids(mesh.edges(), mesh.faces());
  if (dynamic_cast<const ipc::FaceVertexCandidate*>(&c) != nullptr)
    return onset::tests::query_of(onset::PairKind::vertex_face, v, x0, x1);
  std::array<int, 4> rows = v;
  if (c.num_vertices() == 2) rows = {v[0], v[0], v[1], v[1]};
  if (c.num_vertices() == 3) rows = {v[0], v[0], v[1], v[2]};
  return onset::tests::query_of(onset::PairKind::edge_edge, rows, x0, x1);
}

// A narrow phase of somebody's own that tells how often it was asked.
class Counting : public ipc::TightInclusionCCD {
 public:
  std::optional<onset::Options> onset_options() const override { return std::nullopt; }
  bool point_triangle_ccd(const Vector3& p_t0, const Vector3& t0_t0, const Vector3& t1_t0,
                          const Vector3& t2_t0, const Vector3& p_t1, const Vector3& t0_t1,
                          const Vector3& t1_t1, const Vector3& t2_t1, double& toi, double min_distance,
                          double tmax) const override {
    ++count;
    return TightInclusionCCD::point_triangle_ccd(p_t0, t0_t0, t1_t0, t2_t0, p_t1, t0_t1, t1_t1, t2_t1, toi,
                                                 min_distance, tmax);
  }
  mutable int count = 0;
};

}  // namespace

TEST_CASE("candidates are one list, and each can be asked", "[oracle][property]") {
  int of_kind[4] = {}, impacts = 0;
  for (unsigned seed = 1; seed <= unsigned(std::max(12, onset::tests::fuzz(12))); ++seed) {
    const Mixed s(seed, 1);
    const ipc::CollisionMesh mesh = s.mesh();
    ipc::Candidates c;
    c.build(mesh, s.x0, s.x1, 0.05);
    const std::size_t sizes[] = {c.vv_candidates.size(), c.ev_candidates.size(), c.ee_candidates.size(),
                                 c.fv_candidates.size()};
    std::size_t i = 0;
    for (int kind = 0; kind < 4; ++kind)
      for (std::size_t k = 0; k < sizes[kind]; ++k, ++i) {
        CHECK((c.is_vertex_vertex(i) == (kind == 0) && c.is_edge_vertex(i) == (kind == 1)));
        CHECK((c.is_edge_edge(i) == (kind == 2) && c.is_face_vertex(i) == (kind == 3) &&
               !c.is_plane_vertex(i)));
        ++of_kind[kind];
        const ipc::CollisionStencil& pair = c[i];
        const onset::scenes::Query q = query_of(pair, mesh, s.x0, s.x1);
        const auto x0 = pair.dof(s.x0, mesh.edges(), mesh.faces()),
                   x1 = pair.dof(s.x1, mesh.edges(), mesh.faces());
        CHECK((x0.size() == 3 * pair.num_vertices() && pair.dim(int(x0.size())) == 3));
        // The squared distance, and weights that lead from one closest point to the other.
        const onset::oracle::Bracket d = onset::oracle::distance(q, 0);
        CHECK(std::fabs(std::sqrt(pair.compute_distance(x0)) - d.lo) < 1e-14);
        const auto weights = pair.compute_coefficients(x0);
        Eigen::Vector3d apart = Eigen::Vector3d::Zero();
        for (int v = 0; v < pair.num_vertices(); ++v) apart += weights[v] * x0.segment<3>(3 * v);
        CHECK(std::fabs(apart.norm() - d.lo) < 1e-14);
        CHECK(std::fabs(weights.sum()) < 1e-15);
        // Its own query is never late.
        double toi = -1;
        const bool hit = pair.ccd(x0, x1, toi, 0.01);
        const auto truth = onset::oracle::exact_within(q, 0.01);
        impacts += truth.collides && d.lo > 0.01;
        if (d.lo > 0.01 && truth.collides) CHECK((hit && toi > 0 && toi <= truth.toi_lo));
        const auto four = pair.vertices(s.x0, mesh.edges(), mesh.faces());
        for (int v = 0; v < 4; ++v)
          CHECK((v < pair.num_vertices() ? four[std::size_t(v)] == x0.segment<3>(3 * v)
                                         : four[std::size_t(v)].array().isNaN().all()));
      }
    CHECK(i == c.size());
    CHECK_THROWS_AS(c[i], std::out_of_range);
    if (!c.fv_candidates.empty()) {
      c[i - 1].as<ipc::FaceVertexCandidate>().face_id = 77;
      CHECK(c.fv_candidates.back().face_id == 77);
      CHECK_THROWS_AS(c[i - 1].as<ipc::EdgeEdgeCandidate>(), std::bad_cast);
    }
  }
  CAPTURE(of_kind[0], of_kind[1], of_kind[2], of_kind[3], impacts);
  CHECK((of_kind[0] > 3 && of_kind[1] > 10 && of_kind[2] > 10 && of_kind[3] > 10 && impacts > 10));
}

TEST_CASE("candidates are compared as ipc-toolkit compares them", "[unit]") {
  CHECK((ipc::VertexVertexCandidate(1, 2) == ipc::VertexVertexCandidate(2, 1)));
  CHECK((ipc::EdgeEdgeCandidate(1, 2) == ipc::EdgeEdgeCandidate(2, 1)));
  CHECK((ipc::FaceFaceCandidate(1, 2) == ipc::FaceFaceCandidate(2, 1)));
  CHECK((ipc::EdgeVertexCandidate(1, 2) != ipc::EdgeVertexCandidate(2, 1)));
  CHECK((ipc::FaceVertexCandidate(1, 2) != ipc::FaceVertexCandidate(2, 1)));
  CHECK((ipc::EdgeFaceCandidate(1, 2) < ipc::EdgeFaceCandidate(2, 1)));
  CHECK((ipc::EdgeEdgeCandidate(3, 1) < ipc::EdgeEdgeCandidate(2, 2)));
}

TEST_CASE("either narrow phase and any broad phase may be passed, and none is late", "[oracle][property]") {
  int contacts = 0, asked = 0;
  for (unsigned seed = 1; seed <= unsigned(std::max(6, onset::tests::fuzz(6))); ++seed) {
    const Mixed s(seed, 0.8);
    ipc::CollisionMesh mesh = s.mesh();
    ipc::Candidates all;
    all.build(mesh, s.x0, s.x1);
    double exact = INFINITY;
    for (std::size_t i = 0; i < all.size(); ++i)
      exact = std::min(exact, onset::oracle::exact_ccd(query_of(all[i], mesh, s.x0, s.x1)).toi_lo);
    if (exact == 0) continue;
    contacts += exact < INFINITY;
    const ipc::TightInclusionCCD tight;
    const ipc::AdditiveCCD additive;
    const Counting own;
    const ipc::BruteForce brute;
    const ipc::HashGrid grid;
    ipc::LBVH tree;
    const ipc::BroadPhase* const phases[] = {nullptr, &brute, &grid, &tree};
    for (const ipc::NarrowPhaseCCD* ccd :
         {static_cast<const ipc::NarrowPhaseCCD*>(&tight), static_cast<const ipc::NarrowPhaseCCD*>(&additive),
          static_cast<const ipc::NarrowPhaseCCD*>(&own)})
      for (const ipc::BroadPhase* phase : phases) {
        const double step = ipc::compute_collision_free_stepsize(mesh, s.x0, s.x1, 0, phase, *ccd);
        CAPTURE(seed, exact, step, phase == nullptr ? "none" : phase->name(), ccd->conservative_rescaling);
        CHECK(step <= exact);
        CHECK(step == ipc::compute_collision_free_stepsize(mesh, s.x0, s.x1, 0, nullptr, *ccd));
        CHECK(ipc::is_step_collision_free(mesh, s.x0, s.x1, 0, phase, *ccd) <= (exact == INFINITY));
        CHECK(ipc::has_intersections(mesh, s.x0, phase) == ipc::has_intersections(mesh, s.x0));
        const double cfl = all.compute_cfl_stepsize(mesh, s.x0, s.x1, 0.1, 0, phase, *ccd);
        CHECK((cfl <= exact && cfl > 0));
        CHECK(step > 0.1 * std::min(exact, 1.0));  // a fifth of each gap is kept, also by pairs that pass
      }
    asked += own.count;
    // Whoever keeps less of each gap goes farther.
    CHECK(ipc::compute_collision_free_stepsize(mesh, s.x0, s.x1, 0, nullptr, additive) >=
          ipc::compute_collision_free_stepsize(mesh, s.x0, s.x1) - 1e-9);
  }
  CHECK((contacts > 2 && asked > 100));
}

TEST_CASE("filters and narrow phases of one's own leave positions that are not usable at 0", "[unit]") {
  const Mixed s(5);
  ipc::CollisionMesh mesh = s.mesh();
  const Counting own;
  ipc::Candidates some;
  some.build(mesh, s.x0, s.x1);
  for (const double bad : {double(NAN), double(INFINITY), -double(INFINITY), 0x1p1022})
    for (const bool filtered : {false, true})
      for (const bool at_start : {false, true}) {
        CAPTURE(bad, filtered, at_start);
        mesh.can_collide = nullptr;
        if (filtered) mesh.can_collide = [](std::size_t i, std::size_t j) { return i != j; };
        MatrixXd other = s.x1;
        other(3, 2) = bad;
        const MatrixXd &V0 = at_start ? other : s.x0, &V1 = at_start ? s.x0 : other;
        for (const ipc::NarrowPhaseCCD* ccd :
             {static_cast<const ipc::NarrowPhaseCCD*>(&own),
              static_cast<const ipc::NarrowPhaseCCD*>(&ipc::DEFAULT_NARROW_PHASE_CCD)}) {
          CHECK(ipc::compute_collision_free_stepsize(mesh, V0, V1, 0, nullptr, *ccd) == 0);
          CHECK_FALSE(ipc::is_step_collision_free(mesh, V0, V1, 0, nullptr, *ccd));
          CHECK(some.compute_collision_free_stepsize(mesh, V0, V1, 0, *ccd) == 0);
          CHECK_FALSE(some.is_step_collision_free(mesh, V0, V1, 0, *ccd));
          CHECK(some.compute_cfl_stepsize(mesh, V0, V1, 0.1, 0, nullptr, *ccd) == 0);
        }
        CHECK(ipc::has_intersections(mesh, at_start ? V0 : V1));
        CHECK(some.compute_per_vertex_safe_distances(mesh, at_start ? V0 : V1, 0.1).isZero());
        MatrixXd dx = s.x1;
        dx(3, 2) = bad;
        if (!(std::fabs(bad) < INFINITY))
          CHECK(some.compute_noncandidate_conservative_stepsize(mesh, dx, 0.1) == 0);
      }
}

TEST_CASE("a narrow phase of one's own is asked of pairs that are there, and NaN is an impact", "[unit]") {
  class Lost : public Counting {
   public:
    bool point_triangle_ccd(const Vector3&, const Vector3&, const Vector3&, const Vector3&, const Vector3&,
                            const Vector3&, const Vector3&, const Vector3&, double& toi, double,
                            double) const override {
      return toi = NAN, true;
    }
  };
  const Mixed s(5);
  const ipc::CollisionMesh mesh = s.mesh();
  const int vertices = int(mesh.num_vertices()), edges = int(mesh.num_edges()), faces = int(mesh.num_faces());
  ipc::Candidates one;
  one.fv_candidates = {{0, vertices - 1}};
  CHECK(one.compute_collision_free_stepsize(mesh, s.x0, s.x1, 0, Lost()) == 0);
  const auto refused = [&](const ipc::Candidates& some) {
    CHECK_THROWS_AS(some.compute_collision_free_stepsize(mesh, s.x0, s.x1, 0, Lost()), std::invalid_argument);
    CHECK_THROWS_AS(some.is_step_collision_free(mesh, s.x0, s.x1, 0, Lost()), std::invalid_argument);
    CHECK_THROWS_AS(some.compute_collision_free_stepsize(mesh, s.x0, s.x1), std::invalid_argument);
  };
  for (const int wrong : {-1, 1 << 30}) {
    ipc::Candidates some;
    some.fv_candidates = {{wrong < 0 ? -1 : faces, 0}}, refused(some);
    some.fv_candidates = {{0, wrong < 0 ? -1 : vertices}}, refused(some);
    some.fv_candidates.clear();
    some.ee_candidates = {{0, wrong < 0 ? -1 : edges}}, refused(some);
    some.ee_candidates.clear();
    some.ev_candidates = {{0, wrong}}, refused(some);
    some.ev_candidates.clear();
    some.vv_candidates = {{vertices - 1, wrong}}, refused(some);
  }
  CHECK_THROWS_AS(mesh.edge_length(edges), std::out_of_range);
}

TEST_CASE("what safe distances leave of the radius is rounded down", "[unit]") {
  const ipc::CollisionMesh mesh(MatrixXd::Identity(2, 3), MatrixXi(0, 2), MatrixXi(0, 3));
  const Eigen::VectorXd r =
      ipc::Candidates().compute_per_vertex_safe_distances(mesh, MatrixXd::Identity(2, 3) * 100, 1, 0x1p-60);
  CHECK((r.maxCoeff() < 1 && r.maxCoeff() > 0.9));
}

TEST_CASE("the step of what is no candidate moves no vertex farther than half of dhat",
          "[oracle][property]") {
  onset::scenes::Random random(5);
  for (int i = 0; i < std::max(60, onset::tests::fuzz(60)); ++i) {
    const Mixed s(unsigned(1 + i % 4));
    const ipc::CollisionMesh mesh = s.mesh();
    const double size = onset::scenes::power_of_ten(random, -3, 3),
                 dhat = onset::scenes::power_of_ten(random, -5, 1);
    const MatrixXd dx = size * MatrixXd::Random(s.x0.rows(), 3);
    ipc::Candidates none;  // whatever the candidates are: all vertices count
    const double step = none.compute_noncandidate_conservative_stepsize(mesh, dx, dhat);
    REQUIRE((step > 0 && step <= 1));
    double longest = 0;
    for (int v = 0; v < dx.rows(); ++v) {
      Rational square = 0;
      for (int a = 0; a < 3; ++a) square += Rational(dx(v, a)) * Rational(dx(v, a));
      CHECK(4 * square * Rational(step) * Rational(step) <= Rational(dhat) * Rational(dhat));
      longest = std::max(longest, dx.row(v).norm());
    }
    if (step < 1) CHECK(step > 0.999 * dhat / 2 / longest);
  }
  const Mixed s(1);
  const ipc::CollisionMesh mesh = s.mesh();
  CHECK(ipc::Candidates().compute_noncandidate_conservative_stepsize(mesh, MatrixXd::Zero(s.x0.rows(), 3),
                                                                     0.1) == 1);
  CHECK(ipc::Candidates().compute_noncandidate_conservative_stepsize(mesh, s.x0, 0) == 0);
  CHECK_THROWS_AS(ipc::Candidates().compute_noncandidate_conservative_stepsize(mesh, s.x0, -1),
                  std::invalid_argument);
  CHECK_THROWS_AS(ipc::Candidates().compute_noncandidate_conservative_stepsize(mesh, s.x0.topRows(3), 1),
                  std::invalid_argument);
}

TEST_CASE("a step over far ground sees what the candidates of the start do not hold", "[unit]") {
  // Two triangles a unit apart pass through each other; no candidate is within dhat at the start.
  MatrixXd x0(6, 3);
  x0 << 0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, 1, 2, 1, 1, 1, 2, 1;
  MatrixXd x1 = x0;
  x1.bottomRows(3).col(2).array() -= 2;
  const ipc::CollisionMesh mesh(x0, {}, (MatrixXi(2, 3) << 0, 1, 2, 3, 4, 5).finished());
  const double dhat = 1e-3;
  ipc::Candidates c;
  c.build(mesh, x0, dhat / 2);
  REQUIRE(c.empty());
  const double cfl = c.compute_cfl_stepsize(mesh, x0, x1, dhat);
  CHECK((cfl > 0 && cfl < 0.5));
  CHECK((c.compute_noncandidate_conservative_stepsize(mesh, MatrixXd(x1 - x0), dhat) <= dhat / 4));
}

namespace {

// Runs every vertex its distance along a random direction, those of one pair at each other.
MatrixXd pressed(const ipc::CollisionMesh& mesh, const MatrixXd& x, const Eigen::VectorXd& r,
                 const ipc::CollisionStencil& pair, onset::scenes::Random& random) {
  MatrixXd to = x;
  for (int v = 0; v < x.rows(); ++v) {
    Eigen::RowVector3d d;
    for (int a = 0; a < 3; ++a) d[a] = onset::scenes::uniform(random, -1, 1);
    to.row(v) += r[v] * d / d.norm();
  }
  const auto x0 = pair.dof(x, mesh.edges(), mesh.faces());
  const auto weights = pair.compute_coefficients(x0);
  Eigen::Vector3d n = Eigen::Vector3d::Zero();
  for (int i = 0; i < pair.num_vertices(); ++i) n += weights[i] * x0.segment<3>(3 * i);
  n.normalize();
  const auto ids = pair.vertex_ids(mesh.edges(), mesh.faces());
  const int first = dynamic_cast<const ipc::EdgeEdgeCandidate*>(&pair) != nullptr ? 2 : 1;
  for (int i = 0; i < pair.num_vertices(); ++i) {
    const int v = ids[std::size_t(i)];
    to.row(v) = x.row(v) + (i < first ? -1 : 1) * r[v] * n.transpose();
  }
  return to;
}

}  // namespace

TEST_CASE("vertices within their safe distances never meet, all of them moving", "[oracle][property]") {
  onset::scenes::Random random(9);
  int close_calls = 0;
  for (unsigned seed = 1; seed <= unsigned(std::max(12, onset::tests::fuzz(12))); ++seed) {
    const Mixed s(seed);
    ipc::CollisionMesh mesh = s.mesh();
    const bool filtered = seed % 3 == 0;
    if (filtered) mesh.can_collide = [](std::size_t i, std::size_t j) { return (i + j) % 2 == 0; };
    const double min_distance = seed % 2 == 0 ? 0 : 0.004, radius = seed % 4 < 2 ? 0.02 : 0.3;
    ipc::Candidates c, listed;
    listed.build(mesh, s.x0, radius);
    const Eigen::VectorXd r = listed.compute_per_vertex_safe_distances(mesh, s.x0, radius, min_distance);
    REQUIRE(r.size() == s.x0.rows());
    CHECK((r.array() >= 0).all());
    CHECK(r.maxCoeff() <= radius - min_distance);
    CHECK(r == c.compute_per_vertex_safe_distances(mesh, s.x0, radius, min_distance));
    // Half of what ipc-toolkit computes, but for what rounding takes.
    Eigen::VectorXd whole = Eigen::VectorXd::Constant(r.size(), radius - min_distance);
    for (std::size_t i = 0; i < listed.size(); ++i) {
      const double gap =
          std::sqrt(listed[i].compute_distance(s.x0, mesh.edges(), mesh.faces())) - min_distance;
      for (const int v : listed[i].vertex_ids(mesh.edges(), mesh.faces()))
        if (v >= 0) whole[v] = std::min(whole[v], std::max(gap, 0.0));
    }
    CHECK((r.array() <= whole.array()).all());
    CHECK((r.array() >= 0.5 * whole.array() - 1e-12).all());
    c.build(mesh, s.x0, 2 * radius);  // what may come within reach
    for (std::size_t k = 0; k < c.size(); ++k) {
      const MatrixXd to = pressed(mesh, s.x0, r, c[k], random);
      for (const std::size_t i : {k, std::size_t(random()) % c.size()}) {
        const onset::scenes::Query q = query_of(c[i], mesh, s.x0, to);
        if (onset::oracle::distance(q, 0).hi <= min_distance) continue;  // r is 0 there
        const onset::oracle::Truth truth = onset::oracle::exact_within(q, min_distance);
        CAPTURE(seed, k, i, min_distance, radius, truth.toi_lo);
        CHECK_FALSE(truth.collides);
        close_calls += onset::oracle::distance(q, 1).lo < min_distance + 1e-6;
      }
    }
  }
  CHECK(close_calls > 10);  // the bound is used up
}

TEST_CASE("coordinates that are too many are refused", "[unit]") {
  const ipc::FaceVertexCandidate pair(0, 3);
  const Eigen::MatrixXi faces = (Eigen::MatrixXi(1, 3) << 0, 1, 2).finished();
  double toi = 0;
  for (const int size : {0, 1, 8, 11, 13, 15, 1000}) {
    const Eigen::VectorXd x = Eigen::VectorXd::Zero(size), right = Eigen::VectorXd::Zero(12);
    CHECK_THROWS_AS(pair.ccd(x, right, toi), std::invalid_argument);
    CHECK_THROWS_AS(pair.ccd(right, x, toi), std::invalid_argument);
    CHECK_THROWS_AS(pair.compute_distance(x), std::invalid_argument);
    CHECK_THROWS_AS(pair.compute_coefficients(x), std::invalid_argument);
  }
  CHECK_THROWS_AS(pair.dof(MatrixXd::Zero(4, 4), {}, faces), std::invalid_argument);
  CHECK_THROWS_AS(pair.vertices(MatrixXd::Zero(4, 4), {}, faces), std::invalid_argument);
}

TEST_CASE("two points that run at each other share their gap", "[unit]") {
  const MatrixXd x = (MatrixXd(2, 3) << 0, 0, 0, 1, 0, 0).finished();
  const ipc::CollisionMesh mesh(x);
  ipc::Candidates c;
  c.build(mesh, x, 2);
  REQUIRE(c.vv_candidates.size() == 1);
  const Eigen::VectorXd r = c.compute_per_vertex_safe_distances(mesh, x, 2);
  CHECK((r[0] <= 0.5 && r[0] > 0.499 && r[1] == r[0]));
  for (const double all : {0x1p1020, std::numeric_limits<double>::max(), HUGE_VAL}) {
    const Eigen::VectorXd far = c.compute_per_vertex_safe_distances(mesh, x, all);
    CHECK((far[0] <= 0.5 && far[0] >= 0 && far[1] == far[0]));
  }
  CHECK(c.compute_per_vertex_safe_distances(mesh, x, 0.25)[1] <= 0.25);
  CHECK(c.compute_per_vertex_safe_distances(mesh, x, 0.25, 0.25).isZero());
  CHECK_THROWS_AS(c.compute_per_vertex_safe_distances(mesh, x, 0.1, 0.2), std::invalid_argument);
  CHECK_THROWS_AS(c.compute_per_vertex_safe_distances(mesh, x, 0.1, -0.2), std::invalid_argument);
  CHECK_THROWS_AS(c.compute_per_vertex_safe_distances(mesh, x.topRows(1), 0.1), std::invalid_argument);
}
