// The pairs within d-hat: against every pair of the mesh in exact arithmetic.
#include <cstring>
#include <map>

#include "tests/catch.hpp"
#include "tests/narrowphase/exact/exact_pair.hpp"
#include "tests/narrowphase/kernel/kernels.hpp"
#include "tests/oracle/distance.hpp"
#include "tests/scenes/rules.hpp"
#include "tests/src/support/scene_set.hpp"

using namespace onset;
using namespace onset::tests;
using scenes::set_rule;

namespace {

LineSearchOptions within(double d_hat, const Options& options = {}) {
  LineSearchOptions all = options;
  all.d_hat = d_hat;
  return all;
}

using Key = std::tuple<PairKind, int, int>;

std::array<int, 4> vertices_of(const Mesh& mesh, PairKind kind, int a, int b) {
  if (kind == PairKind::vertex_face) return {a, mesh.face(b)[0], mesh.face(b)[1], mesh.face(b)[2]};
  return {mesh.edge(a)[0], mesh.edge(a)[1], mesh.edge(b)[0], mesh.edge(b)[1]};
}

// The boxes of the two primitives are farther apart than d along some axis, without a doubt.
bool boxes_apart(const Eigen::MatrixXd& x, const std::array<int, 4>& v, int side, double d) {
  for (int axis = 0; axis < 3; ++axis) {
    double lo[2] = {INFINITY, INFINITY}, hi[2] = {-INFINITY, -INFINITY};
    for (int i = 0; i < 4; ++i) {
      const double c = x(v[std::size_t(i)], axis);
      lo[i >= side] = std::min(lo[i >= side], c), hi[i >= side] = std::max(hi[i >= side], c);
    }
    if (std::max(lo[0] - hi[1], lo[1] - hi[0]) > d * (1 + 1e-6) + 1e-9) return true;
  }
  return false;
}

Rational squared_distance(const Eigen::MatrixXd& x, PairKind kind, const std::array<int, 4>& v) {
  std::array<RationalVector, 4> p;
  for (std::size_t i = 0; i < 4; ++i)
    for (int a = 0; a < 3; ++a) p[i][std::size_t(a)] = Rational(x(v[i], a));
  const RationalVector d = oracle::shortest_difference(oracle::relative<Rational>(kind, p));
  return dot(d, d);
}

// Exact squared distances of all pairs that share no vertex and are not evidently farther apart than `reach`.
std::map<Key, Rational> brute_force(const Mesh& mesh, const Eigen::MatrixXd& x, double reach) {
  std::map<Key, Rational> all;
  const auto look = [&](PairKind kind, int a, int b) {
    const auto v = vertices_of(mesh, kind, a, b);
    const int side = kind == PairKind::vertex_face ? 1 : 2;
    for (int i = 0; i < side; ++i)
      for (int j = side; j < 4; ++j)
        if (v[std::size_t(i)] == v[std::size_t(j)]) return;
    if (!boxes_apart(x, v, side, reach)) all[{kind, a, b}] = squared_distance(x, kind, v);
  };
  for (int a = 0; a < mesh.num_vertices(); ++a)
    for (int b = 0; b < mesh.num_faces(); ++b) look(PairKind::vertex_face, a, b);
  for (int a = 0; a < mesh.num_edges(); ++a)
    for (int b = a + 1; b < mesh.num_edges(); ++b) look(PairKind::edge_edge, a, b);
  return all;
}

// None within d_hat + separation is missing, none far beyond is listed, and what is listed is right.
void check(const Mesh& mesh, const Eigen::MatrixXd& x, const ClosePairs& close, double separation) {
  const double reach = close.d_hat + separation;
  const std::map<Key, Rational> truth = brute_force(mesh, x, reach * 1.001);
  std::map<Key, const ClosePair*> listed;
  for (const ClosePair& p : close) {
    CHECK((listed.empty() || listed.rbegin()->first < Key(p.kind, p.a, p.b)));  // ordered, each once
    listed[{p.kind, p.a, p.b}] = &p;
    CHECK(p.vertices == vertices_of(mesh, p.kind, p.a, p.b));
  }
  for (const auto& [key, d2] : truth) {
    const auto [kind, a, b] = key;
    CAPTURE(int(kind), a, b, static_cast<double>(d2), reach);
    const auto found = listed.find(key);
    if (found == listed.end()) {
      CHECK(d2 >= Rational(reach) * Rational(reach));
      continue;
    }
    const ClosePair& p = *found->second;
    const double d = std::sqrt(static_cast<double>(d2));
    CHECK(d <= reach + 1e-9);
    CHECK(std::fabs(p.distance - d) <= 1e-9);
    CHECK((p.gap == 0 ||
           Rational(p.gap + p.separation) * Rational(p.gap + p.separation) <= d2 * (1 + Rational(0x1p-50))));
    CHECK(p.gap >= std::min(d - p.separation - 1e-9, d * 0.999 - p.separation) - 1e-7);
    listed.erase(found);
  }
  CHECK(listed.empty());
}

bool same_bytes(const ClosePairs& a, const ClosePairs& b) {
  if (a.size() != b.size() || a.outcome != b.outcome) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const ClosePair &p = a.pairs[i], &q = b.pairs[i];
    if (p.kind != q.kind || p.a != q.a || p.b != q.b || p.vertices != q.vertices ||
        std::memcmp(p.weights.data(), q.weights.data(), sizeof p.weights) != 0 || p.distance != q.distance ||
        p.separation != q.separation || p.gap != q.gap)
      return false;
  }
  return true;
}

}  // namespace

TEST_CASE("the pairs within d-hat are all there, and no others", "[oracle]") {
  std::size_t found = 0;
  for (const NamedScene& named : some_scenes())
    for (const double d_hat : {0.003, 0.08}) {
      CAPTURE(named.name, d_hat);
      const Mesh mesh = named.mesh();
      const ClosePairs close = close_pairs(mesh, named.scene.x_t0, d_hat);
      REQUIRE(close.outcome == Outcome::free);
      found += close.size();
      check(mesh, named.scene.x_t0, close, 0);
    }
  CHECK(found > 1000);
}

TEST_CASE("the line search hands out the pairs within d-hat at any step", "[oracle]") {
  for (const NamedScene& named : some_scenes()) {
    const Mesh mesh = named.mesh();
    const Eigen::MatrixXd &x = named.scene.x_t0, dx = named.scene.x_t1 - x;
    const double d_hat = 0.03;
    const LineSearch search(mesh, x, dx, within(d_hat));
    for (const double step : {0.0, 0.1, 0.7123, 1.0}) {
      CAPTURE(named.name, step);
      const Eigen::MatrixXd there = x + step * dx;
      const ClosePairs close = search.close_pairs(step);
      check(mesh, there, close, 0);
      CHECK(search.close_candidates().total() >= std::int64_t(close.size()));
      const ClosePairs direct = close_pairs(mesh, there, d_hat);  // listed: a marginal pair more at most
      CHECK(close.size() >= direct.size());
      CHECK(close.size() <= direct.size() + 2);
    }
  }
}

// The boxes of a triangle that falls and of one below it do not overlap until the two touch.
TEST_CASE("a pair that comes near without its boxes overlapping keeps a share of its gap, or d-hat",
          "[unit]") {
  Eigen::MatrixXd x(6, 3), dx = Eigen::MatrixXd::Zero(6, 3);
  x << 0, 0, 0, 1, 0, 0, 0, 1, 0, .2, .2, .5, 1.2, .2, .5, .2, 1.2, .5;
  Eigen::MatrixXi F(2, 3);
  F << 0, 1, 2, 3, 4, 5;
  const Mesh mesh(x, F);
  for (const double left : {0.0, 0x1p-60, 0x1p-40, 1e-3, 0.05}) {
    CAPTURE(left);
    dx.col(2).tail(3).array() = left - 0.5;
    const double step = LineSearch(mesh, x, dx).largest_step().step;
    CHECK((x + step * dx)(3, 2) >= std::min(0.1, left < 1e-5 ? 0.1 : left) - 1e-12);
    const double with_d_hat = LineSearch(mesh, x, dx, within(0.01)).largest_step().step;
    CHECK((x + with_d_hat * dx)(3, 2) >= std::min(0.1, left < 0.01 ? 0.1 : left) - 1e-12);
  }
}

TEST_CASE("d-hat is measured beyond separation and thickness", "[oracle]") {
  const NamedScene named = some_scenes()[5];
  Mesh mesh = named.mesh();
  Options options;
  options.min_separation = 0.02;
  check(mesh, named.scene.x_t0, close_pairs(mesh, named.scene.x_t0, 0.15, options), 0.02);
  set_rule(mesh, &CollisionRules::thickness, std::vector<double>(std::size_t(mesh.num_vertices()), 0.01));
  const ClosePairs thick = close_pairs(mesh, named.scene.x_t0, 0.15, options);
  REQUIRE(thick.size() > 0);
  CHECK(std::fabs(thick.pairs[0].separation - 0.04) < 1e-15);
  check(mesh, named.scene.x_t0, thick, 0.04);
  options.norm = Norm::maximum;
  const ClosePairs maximum = close_pairs(mesh, named.scene.x_t0, 0.15, options);
  CHECK(std::fabs(maximum.pairs[0].separation - 0.04 * std::sqrt(3.0)) < 1e-15);
  check(mesh, named.scene.x_t0, maximum, 0.04 * std::sqrt(3.0));
}

TEST_CASE("threads, kernels and broad phases give the same distance set", "[determinism][simd]") {
  for (const NamedScene& named : some_scenes()) {
    const Mesh mesh = named.mesh();
    const Eigen::MatrixXd &x = named.scene.x_t0, dx = named.scene.x_t1 - x;
    Options o;
    o.instruction_set = InstructionSet::scalar;
    o.threads = 1;
    const ClosePairs still = close_pairs(mesh, x, 0.05, o);
    const ClosePairs moved = LineSearch(mesh, x, dx, within(0.05, o)).close_pairs(0.5);
    for (InstructionSet kernel : kernels())
      for (int threads : {1, 4})
        for (BroadPhaseMethod method : {BroadPhaseMethod::brute, BroadPhaseMethod::bvh}) {
          o.instruction_set = kernel, o.threads = threads, o.broad_phase = method;
          CAPTURE(named.name, threads, int(kernel), int(method));
          CHECK(same_bytes(still, close_pairs(mesh, x, 0.05, o)));
          CHECK(same_bytes(moved, LineSearch(mesh, x, dx, within(0.05, o)).close_pairs(0.5)));
        }
  }
}

namespace {

// A vertex and a face, and nothing else.
ClosePairs close_pairs_of(const std::array<std::array<double, 3>, 4>& points, double d_hat) {
  Eigen::MatrixXd x(4, 3);
  for (int i = 0; i < 4; ++i)
    for (int a = 0; a < 3; ++a) x(i, a) = points[std::size_t(i)][std::size_t(a)];
  return close_pairs(Mesh(4, Eigen::RowVector3i(1, 2, 3)), x, d_hat);
}

}  // namespace

TEST_CASE("a vertex above a corner is not listed for a foot that ties with another", "[unit]") {
  const std::array<std::array<double, 3>, 4> x{
      {{0, 0, 0x1.4p-8}, {0, 0, 0}, {1, 0, 0x1.4p-27}, {0, 1, -1}}};  // the distance is 0x1.3ffffffffffffp-8
  CHECK(close_pairs_of(x, 0x1.3fffdbffff5cap-8).size() == 0);
  CHECK(close_pairs_of(x, 0x1.3ffffffffff00p-8).size() == 0);
  const ClosePairs listed = close_pairs_of(x, 0x1.4p-8);
  REQUIRE(listed.size() == 1);
  CHECK(listed.pairs[0].gap >= 0x1.3ffffffffff80p-8);
}

TEST_CASE("a vertex beside a needle has its own distance, and may move", "[unit]") {
  const std::array<std::array<double, 3>, 4> x{
      {{-0x1.1a1904b081edep-8, -0x1.11a7dcb91c158p-3, -0x1.15336b771baa1p-3},
       {0, 0, 0},
       {-0x1.72b3e87a83dcp-6, -0x1.679bf272af91dp-1, -0x1.6c44900134754p-1},
       {-0x1.cd39571109748p-9, -0x1.bf6be4f6a653p-4, -0x1.c537bb7bd54c9p-4}}};
  const ClosePairs close = close_pairs_of(x, 1e-6);
  REQUIRE(close.size() == 1);
  CHECK(std::fabs(close.pairs[0].distance - 6.99102e-14) < 1e-15);
  CHECK(std::fabs(close.pairs[0].gap - 6.99102e-14) < 1e-15);
  Eigen::MatrixXd positions(4, 3);
  for (int i = 0; i < 4; ++i)
    for (int a = 0; a < 3; ++a) positions(i, a) = x[std::size_t(i)][std::size_t(a)];
  const Mesh mesh(4, Eigen::RowVector3i(1, 2, 3));
  for (const double r : safe_distances(mesh, positions, close)) CHECK(r > 3e-14);
}

TEST_CASE("distance sets asked for wrongly are rejected, bad positions are an outcome", "[unit]") {
  const NamedScene named = some_scenes()[3];
  const Mesh mesh = named.mesh();
  Eigen::MatrixXd x = named.scene.x_t0;
  const Eigen::MatrixXd dx = named.scene.x_t1 - x;
  CHECK_THROWS_AS(close_pairs(mesh, x, 0), std::invalid_argument);
  CHECK_THROWS_AS(close_pairs(mesh, x, NAN), std::invalid_argument);
  CHECK_THROWS_AS(close_pairs(mesh, x.topRows(3), 0.1), std::invalid_argument);
  CHECK_THROWS_AS(LineSearch(mesh, x, dx, within(-1)), std::invalid_argument);
  CHECK_THROWS_AS(LineSearch(mesh, x, dx).close_pairs(0.5), std::invalid_argument);
  CHECK_THROWS_AS(LineSearch(mesh, x, dx, within(0.1)).close_pairs(1.5), std::invalid_argument);
  x(7, 1) = NAN;
  const ClosePairs bad = close_pairs(mesh, x, 0.1);
  CHECK(bad.outcome == Outcome::non_finite);
  CHECK(bad.vertex == 7);
  CHECK(bad.size() == 0);
}
