// The broad phases by ipc-toolkit's names: exactly the pairs whose boxes meet.
#include <onset/compat/broad_phase.hpp>
#include <onset/compat/candidates.hpp>

#include "tests/catch.hpp"
#include "tests/fuzz.hpp"
#include "tests/scenes/meshes.hpp"

namespace ipc = onset::ipc;
using Eigen::MatrixXd;
using Eigen::MatrixXi;

namespace {

using Pairs = std::vector<std::array<int, 2>>;

// The ids of a primitive's vertices, and what its boxes are made of.
struct Primitives {
  std::vector<std::vector<int>> vertices;
  explicit Primitives(const MatrixXi& rows) {
    for (int r = 0; r < rows.rows(); ++r) {
      vertices.emplace_back();
      for (int k = 0; k < rows.cols(); ++k) vertices.back().push_back(rows(r, k));
    }
  }
};

bool boxes_meet(const std::vector<int>& a, const std::vector<int>& b, const MatrixXd& x0, const MatrixXd& x1,
                double radius) {
  for (int axis = 0; axis < x0.cols(); ++axis) {
    double lo[2] = {INFINITY, INFINITY}, hi[2] = {-INFINITY, -INFINITY};
    for (int side = 0; side < 2; ++side)
      for (const int v : side == 0 ? a : b)
        for (const double x : {x0(v, axis), x1(v, axis)})
          lo[side] = std::min(lo[side], std::nextafter(x - radius, -INFINITY)),
          hi[side] = std::max(hi[side], std::nextafter(x + radius, INFINITY));
    if (lo[0] > hi[1] || lo[1] > hi[0]) return false;
  }
  return true;
}

Pairs by_brute_force(const Primitives& a, const Primitives& b, bool same, const MatrixXd& x0,
                     const MatrixXd& x1, double radius, const ipc::CollisionFilter& may) {
  Pairs r;
  for (std::size_t i = 0; i < a.vertices.size(); ++i)
    for (std::size_t j = same ? i + 1 : 0; j < b.vertices.size(); ++j) {
      bool any = false, shared = false;
      for (const int v : a.vertices[i])
        for (const int w : b.vertices[j]) shared = shared || v == w, any = any || may(v, w);
      if (any && !shared && boxes_meet(a.vertices[i], b.vertices[j], x0, x1, radius))
        r.push_back({int(i), int(j)});
    }
  return r;
}

template <class Candidate>
Pairs listed(const ipc::BroadPhase& phase, void (ipc::BroadPhase::*detect)(std::vector<Candidate>&) const) {
  std::vector<Candidate> found;
  (phase.*detect)(found);
  Pairs r;
  for (const auto& c : found) {
    const auto& [a, b] = c;
    r.push_back({a, b});
  }
  return r;
}

MatrixXi column(int n) { return Eigen::VectorXi::LinSpaced(n, 0, n - 1); }

}  // namespace

TEST_CASE("every broad phase lists the pairs of boxes that meet, all kinds, in order", "[property]") {
  int pairs = 0;
  for (unsigned seed = 1; seed <= unsigned(std::max(6, onset::tests::fuzz(6))); ++seed) {
    onset::scenes::Random random(seed);
    const auto soup = onset::scenes::triangle_soup(14, 0.6, 0.2, random);
    const bool in_plane = seed % 3 == 0;
    MatrixXd x0 = soup.x_t0, x1 = seed % 2 == 0 ? soup.x_t0 : soup.x_t1;
    if (in_plane) x0 = MatrixXd(x0.leftCols(2)), x1 = MatrixXd(x1.leftCols(2));
    MatrixXi faces = soup.faces;
    if (seed % 4 == 1) faces(3, 0) = faces(2, 0);  // two faces with a common vertex
    const MatrixXi edges = onset::edges(faces);
    const double radius = seed % 2 == 0 ? 0.05 : 0;
    const Primitives v(column(int(x0.rows()))), e(edges), f(faces);
    for (const auto method :
         {ipc::BroadPhaseMethod::BRUTE_FORCE, ipc::BroadPhaseMethod::HASH_GRID,
          ipc::BroadPhaseMethod::SPATIAL_HASH, ipc::BroadPhaseMethod::LBVH,
          ipc::BroadPhaseMethod::SWEEP_AND_PRUNE, ipc::BroadPhaseMethod::SWEEP_AND_TINIEST_QUEUE}) {
      const std::shared_ptr<ipc::BroadPhase> phase = ipc::create_broad_phase(method);
      CAPTURE(seed, phase->name());
      if (seed > 2)
        phase->can_vertices_collide = [](std::size_t i, std::size_t j) { return (i + j) % 3 == 0; };
      if (seed % 2 == 0)
        phase->build(x0, edges, faces, radius);
      else
        phase->build(x0, x1, edges, faces, radius);
      const auto expected = [&](const Primitives& a, const Primitives& b) {
        return by_brute_force(a, b, &a == &b, x0, x1, radius, phase->can_vertices_collide);
      };
      CHECK(listed(*phase, &ipc::BroadPhase::detect_vertex_vertex_candidates) == expected(v, v));
      CHECK(listed(*phase, &ipc::BroadPhase::detect_edge_vertex_candidates) == expected(e, v));
      CHECK(listed(*phase, &ipc::BroadPhase::detect_edge_edge_candidates) == expected(e, e));
      CHECK(listed(*phase, &ipc::BroadPhase::detect_face_vertex_candidates) == expected(f, v));
      CHECK(listed(*phase, &ipc::BroadPhase::detect_edge_face_candidates) == expected(e, f));
      CHECK(listed(*phase, &ipc::BroadPhase::detect_face_face_candidates) == expected(f, f));
      ipc::Candidates all;
      all.fv_candidates.emplace_back(0, 0);
      phase->detect_collision_candidates(all);
      CHECK(all.size() == (in_plane ? expected(e, v).size() : expected(e, e).size() + expected(f, v).size()));
      pairs += int(all.size());
      phase->clear();
      phase->detect_collision_candidates(all);
      CHECK(all.empty());
    }
  }
  CHECK(pairs > 500);
}

TEST_CASE("broad phases have ipc-toolkit's names and say which of onset's they are", "[unit]") {
  CHECK(ipc::make_default_broad_phase()->name() == "LBVH");
  CHECK(ipc::BVH().name() == "BVH");
  CHECK(ipc::BruteForce().name() == "BruteForce");
  CHECK(ipc::HashGrid().name() == "HashGrid");
  CHECK(ipc::SpatialHash().name() == "SpatialHash");
  CHECK(ipc::SweepAndPrune().name() == "SweepAndPrune");
  CHECK(ipc::SweepAndTiniestQueue().name() == "SweepAndTiniestQueue");
  CHECK(ipc::BruteForce().onset_method() == onset::BroadPhaseMethod::brute);
  CHECK(ipc::HashGrid().onset_method() == onset::BroadPhaseMethod::hash);
  CHECK(ipc::SpatialHash().onset_method() == onset::BroadPhaseMethod::hash);
  CHECK(ipc::SweepAndPrune().onset_method() == onset::BroadPhaseMethod::bvh);
  CHECK_THROWS_AS(ipc::create_broad_phase(ipc::BroadPhaseMethod(9)), std::runtime_error);
}

TEST_CASE("broad phases refuse what has no boxes", "[unit]") {
  ipc::LBVH phase;
  const MatrixXd x = MatrixXd::Random(6, 3);
  const MatrixXi faces = (MatrixXi(2, 3) << 0, 1, 2, 3, 4, 5).finished();
  const MatrixXi edges = onset::edges(faces);
  CHECK_THROWS_AS(phase.build(x, MatrixXd::Zero(5, 3), edges, faces), std::invalid_argument);
  CHECK_THROWS_AS(phase.build(MatrixXd::Zero(6, 4), edges, faces), std::invalid_argument);
  CHECK_THROWS_AS(phase.build(x, faces, faces), std::invalid_argument);
  CHECK_THROWS_AS(phase.build(x, edges, faces, -1), std::invalid_argument);
  CHECK_THROWS_AS(phase.build(MatrixXd(x.topRows(5)), edges, faces), std::invalid_argument);
  std::vector<ipc::FaceFaceCandidate> found;
  for (const double bad : {double(NAN), double(INFINITY), 0x1p1021})
    for (const bool at_start : {false, true}) {
      MatrixXd other = x;
      other(4, 1) = bad;
      phase.build(at_start ? other : x, at_start ? x : other, edges, faces);
      CHECK_THROWS_AS(phase.detect_face_face_candidates(found), std::runtime_error);
    }
  phase.build(MatrixXd(0, 3), MatrixXi(0, 2), MatrixXi(0, 3));
  phase.detect_face_face_candidates(found);
  CHECK(found.empty());
}

TEST_CASE("filters combine", "[unit]") {
  const ipc::CollisionFilter all, even = [](std::size_t i, std::size_t j) { return (i + j) % 2 == 0; };
  const ipc::CollisionFilter low = [](std::size_t i, std::size_t j) { return i + j < 5; };
  CHECK((all.accepts_all() && !even.accepts_all() && (all | even).accepts_all()));
  CHECK((all(0, 0) && all(3, 900)));
  ipc::CollisionFilter both = even, either = even;
  both &= low, either |= low;
  const std::function<bool(std::size_t, std::size_t)> plain = even, empty;
  CHECK((ipc::CollisionFilter(empty).accepts_all() && ipc::CollisionFilter(nullptr).accepts_all()));
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j) {
      const bool e = (i + j) % 2 == 0, l = i + j < 5;
      CHECK(((even & low)(i, j) == (e && l) && (even | low)(i, j) == (e || l) && (!even)(i, j) == !e));
      CHECK((both(i, j) == (e && l) && either(i, j) == (e || l) && (all & low)(i, j) == l));
      CHECK((!all)(i, j) == false);
      CHECK(plain(i, j) == e);
    }
  const Eigen::VectorXi patches = (Eigen::VectorXi(3) << 0, 0, 7).finished();
  CHECK((!ipc::make_vertex_patches_filter(patches)(0, 1) && ipc::make_vertex_patches_filter(patches)(1, 2)));
  CHECK((!ipc::make_static_obstacle_filter(2)(2, 3) && ipc::make_static_obstacle_filter(2)(3, 1)));
  CHECK((!ipc::make_codim_cross_filter(2)(0, 1) && ipc::make_codim_cross_filter(2)(0, 3) &&
         !ipc::make_codim_cross_filter(2)(2, 3)));
  const MatrixXi faces = (MatrixXi(3, 3) << 0, 1, 2, 2, 1, 3, 4, 5, 6).finished();
  const ipc::CollisionFilter parts = ipc::make_connected_components_filter(faces);
  CHECK((!parts(0, 3) && !parts(4, 6) && parts(3, 4)));
  CHECK_THROWS_AS(parts(0, 7), std::out_of_range);
}
