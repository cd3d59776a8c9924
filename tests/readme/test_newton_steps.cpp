// A thousand Newton-like steps into contact by the README's loop, and a thousand straight into it without a
// barrier: none of length 0, and no penetration on the way by exact arithmetic nor at its stations by FCL.
#include <cmath>

#include "documented.hpp"
#include "tests/catch.hpp"
#include "tests/fcl/bodies.hpp"
#include "tests/oracle/oracle.hpp"
#include "tests/scenes/meshes.hpp"

using namespace onset;

namespace {

// A ball that is pulled into a cube at rest; both small, for the sake of exact arithmetic.
struct BallAndCube {
  scenes::Scene scene;
  Eigen::Index ball;  // rows of the ball's vertices, which come first
  Mesh mesh() const { return Mesh(scene.x_t0, scene.faces); }
};

BallAndCube ball_above_cube(scenes::Random& random) {
  scenes::Scene ball = scenes::sphere(3, 6);
  ball.x_t0 *= 0.5;
  ball = scenes::translated(ball, {scenes::uniform(random, -1.2, 1.2), scenes::uniform(random, -1.2, 1.2),
                                   scenes::uniform(random, 1.6, 1.9)});
  for (Eigen::Index v = 0; v < ball.x_t0.rows(); ++v)
    for (int a = 0; a < 3; ++a) ball.x_t0(v, a) += scenes::uniform(random, -0.05, 0.05);
  return {scenes::joined(ball, scenes::cube()), ball.x_t0.rows()};
}

// Whether any pair whose swept boxes overlap touches on the straight way from x_t0 to x_t1.
class Exact {
 public:
  explicit Exact(const Mesh& mesh) : mesh_(mesh) {}

  bool touches(const Eigen::MatrixXd& x_t0, const Eigen::MatrixXd& x_t1) {
    for (int a = 0; a < mesh_.num_vertices(); ++a)
      for (int b = 0; b < mesh_.num_faces(); ++b) {
        const auto f = mesh_.face(b);
        if (touches(PairKind::vertex_face, {a, f[0], f[1], f[2]}, x_t0, x_t1)) return true;
      }
    for (int a = 0; a < mesh_.num_edges(); ++a)
      for (int b = a + 1; b < mesh_.num_edges(); ++b) {
        const auto e = mesh_.edge(a), g = mesh_.edge(b);
        if (touches(PairKind::edge_edge, {e[0], e[1], g[0], g[1]}, x_t0, x_t1)) return true;
      }
    return false;
  }
  long long asked = 0;

 private:
  bool touches(PairKind kind, const std::array<int, 4>& v, const Eigen::MatrixXd& x_t0,
               const Eigen::MatrixXd& x_t1) {
    const int side = kind == PairKind::vertex_face ? 1 : 2;
    for (int i = 0; i < side; ++i)
      for (int j = side; j < 4; ++j)
        if (v[std::size_t(i)] == v[std::size_t(j)]) return false;
    scenes::Query q;
    q.kind = kind;
    for (std::size_t a = 0; a < 3; ++a) {
      double lo[2] = {INFINITY, INFINITY}, hi[2] = {-INFINITY, -INFINITY};
      for (std::size_t i = 0; i < 4; ++i) {
        q.t0[i][a] = x_t0(v[i], Eigen::Index(a)), q.t1[i][a] = x_t1(v[i], Eigen::Index(a));
        const bool second = int(i) >= side;
        lo[second] = std::min({lo[second], q.t0[i][a], q.t1[i][a]});
        hi[second] = std::max({hi[second], q.t0[i][a], q.t1[i][a]});
      }
      if (lo[0] > hi[1] || lo[1] > hi[0]) return false;
    }
    ++asked;
    return oracle::exact_ccd(q).collides;
  }

  const Mesh& mesh_;
};

// Half the squared distance to a place inside the cube, and a logarithmic barrier on the pairs within d_hat.
// Notes every position that the loop asks for a direction at: its steps, seen from outside.
struct Pull {
  Eigen::MatrixXd target;
  Eigen::Index ball;
  double kappa, d_hat;
  std::vector<Eigen::MatrixXd>* visited;

  double operator()(const Eigen::MatrixXd& x, const ClosePairs& near) const {
    double sum = 0.5 * (x - target).topRows(ball).squaredNorm();
    for (const ClosePair& p : near) {
      const double y = p.distance / d_hat;
      if (y < 1) sum -= kappa * (y - 1) * (y - 1) * std::log(y);
    }
    return sum;
  }

  Eigen::MatrixXd newton_direction(const Eigen::MatrixXd& x, const ClosePairs& near) const {
    visited->push_back(x);
    const Eigen::Index n = 3 * ball;
    Eigen::VectorXd g(n);
    for (Eigen::Index v = 0; v < ball; ++v) g.segment<3>(3 * v) = (x - target).row(v).transpose();
    Eigen::MatrixXd H = Eigen::MatrixXd::Identity(n, n);
    for (const ClosePair& p : near) {
      const double y = p.distance / d_hat;
      if (!(y < 1)) continue;
      Eigen::Vector3d w = Eigen::Vector3d::Zero();
      for (std::size_t i = 0; i < 4; ++i) w += p.weights[i] * x.row(p.vertices[i]).transpose();
      Eigen::VectorXd along = Eigen::VectorXd::Zero(n);  // the gradient of the distance
      for (std::size_t i = 0; i < 4; ++i)
        if (p.vertices[i] < ball) along.segment<3>(3 * p.vertices[i]) += p.weights[i] * w.normalized();
      const double slope = -kappa * (2 * (y - 1) * std::log(y) + (y - 1) * (y - 1) / y);
      const double bend = -kappa * (2 * std::log(y) + 4 * (y - 1) / y - (y - 1) * (y - 1) / (y * y));
      g += slope / d_hat * along;
      H += bend / (d_hat * d_hat) * along * along.transpose();
    }
    const Eigen::VectorXd d = H.ldlt().solve(-g);
    Eigen::MatrixXd dx = Eigen::MatrixXd::Zero(x.rows(), 3);
    for (Eigen::Index v = 0; v < ball; ++v) dx.row(v) = d.segment<3>(3 * v).transpose();
    return dx;
  }
};

}  // namespace

// Every time step pulls the ball from where it is down by 0.08, which the cube soon resists.
TEST_CASE("a thousand of the README's Newton steps into contact", "[oracle][fcl]") {
  scenes::Random random(4);
  int steps = 0, limited = 0;
  long long asked = 0;
  for (int run = 0; steps < 1000; ++run) {
    REQUIRE(run < 100);
    const BallAndCube bodies = ball_above_cube(random);
    const Mesh mesh = bodies.mesh();
    Exact exact(mesh);
    const double d_hat = scenes::power_of_ten(random, -2, -1), kappa = scenes::power_of_ten(random, -5, -3);
    Eigen::MatrixXd x = bodies.scene.x_t0;
    REQUIRE_FALSE(fcl_test::intersect(x, bodies.scene.faces, int(bodies.ball)));
    for (int time = 0; time < 12; ++time) {
      std::vector<Eigen::MatrixXd> visited;
      Pull pull{x, bodies.ball, kappa, d_hat, &visited};
      pull.target.topRows(bodies.ball).rowwise() += Eigen::RowVector3d(0, 0, -0.08);
      x = newton(pull, mesh, x, d_hat);
      visited.push_back(x);
      const std::size_t stations = visited.size();
      for (std::size_t i = 0; i + 1 < stations; ++i) {
        const Eigen::MatrixXd from = visited[i], to = visited[i + 1];
        const Eigen::MatrixXd dx = pull.newton_direction(from, close_pairs(mesh, from, d_hat));
        if (dx.cwiseAbs().maxCoeff() < 1e-8) break;  // at rest: what follows is rounding
        CAPTURE(run, time, i, steps, d_hat, kappa);
        LineSearchOptions options;
        options.d_hat = d_hat;
        const LineSearchStep allowed = LineSearch(mesh, from, dx, options).largest_step();
        CHECK(allowed.step > 0);
        limited += allowed.outcome == Outcome::contact;
        CHECK((to - from).cwiseAbs().maxCoeff() > 0);
        CHECK_FALSE(exact.touches(from, to));
        CHECK_FALSE(fcl_test::intersect(to, bodies.scene.faces, int(bodies.ball)));
        ++steps;
      }
    }
    asked += exact.asked;
  }
  CHECK(limited > 50);  // the filter was needed
  CHECK(asked > 10000);
}

TEST_CASE("a thousand steps straight into contact approach it and never arrive", "[oracle][fcl]") {
  scenes::Random random(6);
  const BallAndCube bodies = ball_above_cube(random);
  const Mesh mesh = bodies.mesh();
  Eigen::MatrixXd x = bodies.scene.x_t0, target = x;
  target.topRows(bodies.ball).rowwise() += Eigen::RowVector3d(0, 0, -2);
  Exact exact(mesh);
  const double at_start = fcl_test::distance(x, bodies.scene.faces, int(bodies.ball));
  LineSearchOptions options;
  options.gap_share = 0.97;
  for (int i = 0; i < 1000; ++i) {
    CAPTURE(i);
    const LineSearchStep r = LineSearch(mesh, x, target - x, options).largest_step();
    REQUIRE(r.step > 0);
    REQUIRE(r.outcome == Outcome::contact);
    CHECK(r.assured);
    const Eigen::MatrixXd next = x + r.step * (target - x);
    CHECK(next != x);
    CHECK_FALSE(exact.touches(x, next));
    CHECK_FALSE(fcl_test::intersect(next, bodies.scene.faces, int(bodies.ball)));
    x = next;
  }
  const double left = fcl_test::distance(x, bodies.scene.faces, int(bodies.ball));
  CHECK(left < 1e-8 * at_start);  // 0.97 to 0.9775 of the gap is kept by each: 1e-10 to 6e-14 of it
  CHECK(exact.asked > 1000);
}
