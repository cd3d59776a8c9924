// The other calls on meshes in the plane: candidates, line searches, distances, constraints, same bytes.
#include <onset/compat/ipc.hpp>

#include "tests/catch.hpp"
#include "tests/in_plane/support/plane_scenes.hpp"
#include "tests/oracle/promises.hpp"
#include "tests/src/support/answer.hpp"

using namespace onset;
using namespace onset::tests;

namespace {

double distance(const PlanePoint& p, const PlanePoint& a, const PlanePoint& b) {
  const double ex = b[0] - a[0], ey = b[1] - a[1], wx = p[0] - a[0], wy = p[1] - a[1];
  const double size = ex * ex + ey * ey;
  const double s = size > 0 ? std::min(1.0, std::max(0.0, (wx * ex + wy * ey) / size)) : 0;
  return std::hypot(wx - s * ex, wy - s * ey);
}

double distance(const PlaneScene& s, const Eigen::MatrixXd& x, int v, int e) {
  const auto at = [&](int i) { return PlanePoint{x(i, 0), x(i, 1)}; };
  return distance(at(v), at(s.edges(e, 0)), at(s.edges(e, 1)));
}

PlaneScene some(std::uint64_t seed, double speed = 0.5) {
  scenes::Random random(oracle::fuzz_seed() + seed);
  return polygons(9, speed, random);
}

}  // namespace

TEST_CASE("in the plane: every broad phase finds the same pairs, those with a contact among them") {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const PlaneScene s = some(seed);
    const Mesh mesh = s.mesh();
    Options options;
    options.broad_phase = BroadPhaseMethod::brute;
    const Candidates brute = compute_candidates(mesh, s.x_t0, s.x_t1, options);
    CHECK((brute.vertex_face.empty() && brute.edge_edge.empty() && !brute.vertex_edge.empty()));
    CHECK(brute.counts.vertex_edge == std::int64_t(brute.vertex_edge.size()));
    for (const BroadPhaseMethod method : {BroadPhaseMethod::bvh, BroadPhaseMethod::hash}) {
      options.broad_phase = method;
      CHECK(compute_candidates(mesh, s.x_t0, s.x_t1, options).vertex_edge == brute.vertex_edge);
    }
    for (const auto& [pair, truth] : contacts_of(s))
      CHECK(std::binary_search(brute.vertex_edge.begin(), brute.vertex_edge.end(), pair));
    const StepResult whole = compute_collision_free_stepsize(mesh, s.x_t0, s.x_t1);
    CHECK(compute_collision_free_stepsize(mesh, brute, s.x_t0, s.x_t1).step == whole.step);
  }
}

TEST_CASE("in the plane: the same bytes for any threads, instruction set and broad phase") {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const PlaneScene s = some(100 + seed);
    const auto ask = [&](const Options& o) {
      const Mesh mesh = s.mesh();
      LineSearchOptions search = o;
      search.d_hat = 0.05;
      Answer a;
      a.add(construct_active_set(mesh, s.x_t0, s.x_t1, o),
            compute_collision_free_stepsize(mesh, s.x_t0, s.x_t1, o), close_pairs(mesh, s.x_t0, 0.1, o),
            check(mesh, s.x_t1, o).touching.size(), intersections(mesh, s.x_t1, o),
            LineSearch(mesh, s.x_t0, s.x_t1 - s.x_t0, search).largest_step());
      return a;
    };
    const Answer expected = ask({});
    for (const int threads : {1, 2, 3})
      for (const InstructionSet kernel : {InstructionSet::scalar, InstructionSet::automatic})
        for (const BroadPhaseMethod method :
             {BroadPhaseMethod::bvh, BroadPhaseMethod::hash, BroadPhaseMethod::brute}) {
          Options o;
          o.threads = threads, o.instruction_set = kernel, o.broad_phase = method;
          CHECK(ask(o) == expected);
        }
  }
}

TEST_CASE("in the plane: exchanging the axes gives the same step and contacts") {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const PlaneScene s = some(200 + seed);
    PlaneScene turned = s;
    turned.x_t0.col(0).swap(turned.x_t0.col(1)), turned.x_t1.col(0).swap(turned.x_t1.col(1));
    CHECK(compute_collision_free_stepsize(s.mesh(), s.x_t0, s.x_t1).step ==
          compute_collision_free_stepsize(turned.mesh(), turned.x_t0, turned.x_t1).step);
    const ActiveSet a = construct_active_set(s.mesh(), s.x_t0, s.x_t1),
                    b = construct_active_set(turned.mesh(), turned.x_t0, turned.x_t1);
    REQUIRE(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      CHECK((a[i].a == b[i].a && a[i].b == b[i].b && a[i].toi == b[i].toi && a[i].gap == b[i].gap));
      CHECK((a[i].normal[0] == b[i].normal[1] && a[i].normal[1] == b[i].normal[0]));
    }
  }
}

TEST_CASE("in the plane: close pairs are those within d-hat, with their distances") {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const PlaneScene s = some(300 + seed);
    const double d_hat = 0.15;
    const ClosePairs close = close_pairs(s.mesh(), s.x_t0, d_hat);
    std::size_t expected = 0;
    for (int v = 0; v < s.x_t0.rows(); ++v)
      for (int e = 0; e < s.edges.rows(); ++e)
        expected += s.edges(e, 0) != v && s.edges(e, 1) != v && distance(s, s.x_t0, v, e) < d_hat;
    CHECK(close.size() == expected);
    for (const ClosePair& p : close) {
      CHECK(p.kind == PairKind::vertex_edge);
      CHECK(std::abs(p.distance - distance(s, s.x_t0, p.a, p.b)) < 1e-14);
      CHECK((p.weights[0] == 1 && p.weights[1] + p.weights[2] == -1 && p.weights[3] == 0));
    }
    const std::vector<double> safe = safe_distances(s.mesh(), s.x_t0, close);
    const double step = safe_step(safe, s.x_t1 - s.x_t0);
    CHECK(step > 0);
    CHECK_FALSE(any_common_point(s.x_t0 + step * (s.x_t1 - s.x_t0), s.edges));
    CHECK(compute_cfl_stepsize(s.mesh(), s.x_t0, s.x_t1, close).step > 0);
  }
}

TEST_CASE("in the plane: lines that are folded for many steps never pass through each other") {
  scenes::Random random(oracle::fuzz_seed());
  for (int run = 0; run < oracle::fuzz(4); ++run) {
    const int n = 24;
    PlaneScene s;
    s.x_t0.resize(2 * n, 2);
    std::vector<std::array<int, 2>> edges;
    for (int line = 0; line < 2; ++line)
      for (int k = 0; k < n; ++k) {
        s.x_t0.row(line * n + k) << k, 2 * line + 0.3 * (k % 2);
        if (k > 0) edges.push_back({line * n + k - 1, line * n + k});
      }
    s.edges = edge_matrix(edges);
    const Mesh mesh = s.mesh();
    Eigen::MatrixXd x = s.x_t0;
    int shortened = 0;
    for (int step = 0; step < oracle::fuzz(60); ++step) {
      Eigen::MatrixXd dx(2 * n, 2);
      for (int v = 0; v < 2 * n; ++v)
        dx.row(v) << 0.3 * (n / 2.0 - x(v, 0)) + scenes::uniform(random, -0.5, 0.5),
            0.3 * (1 - x(v, 1)) + scenes::uniform(random, -1, 1);
      const LineSearchStep r = LineSearch(mesh, x, dx).largest_step();
      shortened += r.step < 1;
      REQUIRE((r.step > 0 || r.outcome == Outcome::below_rounding));
      x += r.step * dx;
      REQUIRE_FALSE(any_common_point(x, s.edges));
    }
    CHECK(shortened > oracle::fuzz(60) / 6 - 1);
  }
}

TEST_CASE("in the plane: constraints and degrees of freedom have two of a vertex") {
  const PlaneScene s = some(400);
  Mesh mesh = s.mesh();
  const ActiveSet set = construct_active_set(mesh, s.x_t0, s.x_t1);
  REQUIRE(set.size() > 0);
  const Constraints c = assemble_constraints(set, 0.25);
  REQUIRE(c.value.size() == 6 * set.size());
  for (std::size_t i = 0; i < set.size(); ++i) {
    // What the row says of positions at the time of impact is the gap.
    double sum = 0;
    for (std::size_t k = 6 * i; k < 6 * i + 6; ++k) {
      const int v = c.dof[k] / 2, axis = c.dof[k] % 2;
      CHECK(c.row[k] == int(i));
      sum += c.value[k] * ((1 - set[i].toi) * s.x_t0(v, axis) + set[i].toi * s.x_t1(v, axis));
    }
    CHECK(std::abs(sum - set[i].gap) < 1e-12);
    const auto dofs = mesh.full_dofs(set[i]);
    for (std::size_t k = 0; k < 6; ++k) CHECK(dofs[k] == c.dof[6 * i + k]);
    for (std::size_t k = 6; k < 12; ++k) CHECK(dofs[k] == -1);
  }
}

TEST_CASE("in the plane: the adapter has dim 2") {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const PlaneScene s = some(500 + seed);
    ipc::CollisionMesh mesh(s.x_t0, s.edges);
    CHECK((mesh.dim() == 2 && mesh.ndof() == std::size_t(2 * s.x_t0.rows())));
    const auto contacts = contacts_of(s);
    double first = 1;
    for (const auto& [pair, truth] : contacts) first = std::min(first, truth.lo);
    const double step = ipc::compute_collision_free_stepsize(mesh, s.x_t0, s.x_t1);
    CHECK((step > 0 && step <= first));
    CHECK(ipc::is_step_collision_free(mesh, s.x_t0, s.x_t1) == contacts.empty());
    CHECK(ipc::has_intersections(mesh, s.x_t1) == any_common_point(s.x_t1, s.edges));
    CHECK_FALSE(ipc::has_intersections(mesh, s.x_t0));
    ipc::Candidates candidates;
    candidates.build(mesh, s.x_t0, s.x_t1);
    CHECK((candidates.ev_candidates.size() == candidates.size() && candidates.size() > 0));
    const double listed = candidates.compute_collision_free_stepsize(mesh, s.x_t0, s.x_t1);
    CHECK((listed > 0 && listed <= first));
    mesh.can_collide = [](std::size_t, std::size_t) { return false; };
    CHECK(ipc::compute_collision_free_stepsize(mesh, s.x_t0, s.x_t1) == 1);
    CHECK_THROWS_AS(mesh.require_surface(Eigen::MatrixXd(s.x_t0.rows(), 3)), std::invalid_argument);
    const Eigen::VectorXd gradient = Eigen::VectorXd::Ones(Eigen::Index(mesh.ndof()));
    CHECK(mesh.to_full_dof(gradient) == gradient);
  }
}

TEST_CASE("in the plane: planes keep vertices out of every call of the adapter") {
  Eigen::MatrixXd x(2, 2), x_new(2, 2);
  x << 0, 1, 1, 1;
  x_new << 0, -1.5, 1, -1.5;
  ipc::CollisionMesh mesh(x, Eigen::RowVector2i(0, 1));
  mesh.set_planes({{{0, 1, 0}, 0}});
  for (const bool filtered : {false, true}) {
    if (filtered) mesh.can_collide = [](std::size_t, std::size_t) { return true; };
    const auto is_right = [](double step) { return step > 0.319 && step <= 0.32; };
    CHECK(is_right(ipc::compute_collision_free_stepsize(mesh, x, x_new)));
    CHECK_FALSE(ipc::is_step_collision_free(mesh, x, x_new));
    ipc::Candidates candidates;
    candidates.build(mesh, x, x_new);
    CHECK(candidates.pv_candidates.size() == 2);
    CHECK(is_right(candidates.compute_collision_free_stepsize(mesh, x, x_new)));
    CHECK_FALSE(candidates.is_step_collision_free(mesh, x, x_new));
    CHECK(candidates.compute_cfl_stepsize(mesh, x, x_new, 0.1) <= 0.32);
    Eigen::MatrixXd bad = x_new;
    bad(1, 0) = NAN;
    CHECK(candidates.compute_cfl_stepsize(mesh, x, bad, 0.1) == 0);
    CHECK(candidates.compute_cfl_stepsize(mesh, bad, x_new, 0.1) == 0);
    candidates.ee_candidates.push_back({0, 0});
    CHECK_THROWS_WITH(candidates.compute_collision_free_stepsize(mesh, x, x_new),
                      Catch::Contains("have no place in two dimensions"));
    candidates.ee_candidates.clear(), candidates.fv_candidates.push_back({0, 0});
    CHECK_THROWS_AS(candidates.is_step_collision_free(mesh, x, x_new), std::invalid_argument);
  }
}
