// Planes of the mesh keep what truncate_step returns in front of them, exactly, and the pairs stay apart too.
#include <cmath>
#include <cstdio>

#include "tests/catch.hpp"
#include "tests/oracle/promises.hpp"
#include "tests/planes/plane_truth.hpp"
#include "tests/vertex_steps/near_scenes.hpp"

using namespace onset;
using namespace onset::tests;
using Eigen::RowVector3d;

namespace {

// A plane that all vertices are in front of, as far as doubles tell, the nearest about `gap` away.
Plane plane_below(const NearScene& near, double gap, scenes::Random& random) {
  Plane plane;
  RowVector3d n;
  for (int a = 0; a < 3; ++a) n[a] = scenes::coin(random) ? 0 : scenes::uniform(random, -1, 1);
  if (n.isZero()) n[2] = 1;
  n *= scenes::power_of_ten(random, -20, 20);
  plane.offset = (near.scene.x_t0 * n.transpose()).minCoeff() - gap * n.norm();
  for (std::size_t a = 0; a < 3; ++a) plane.normal[a] = n[Eigen::Index(a)];
  return plane;
}

RowVector3d row(const std::vector<double>& x, std::size_t v) {
  return {x[3 * v], x[3 * v + 1], x[3 * v + 2]};
}

}  // namespace

TEST_CASE("no vertex goes behind a plane on the way to what is stored", "[oracle][property]") {
  const int count = oracle::fuzz(400);
  std::size_t stopped = 0, touching = 0, within = 0, moved = 0;
  for (int i = 0; i < count; ++i) {
    scenes::Random random(oracle::fuzz_seed() * 7000003 + std::uint64_t(i));
    const NearScene near = near_scene(random);
    const double size = near.scene.x_t0.cwiseAbs().maxCoeff();
    CollisionRules rules = near.scene.mesh().rules();
    for (int p = 0; p <= i % 2; ++p)
      rules.planes.push_back(plane_below(
          near, scenes::integer(random, 0, 9) == 0 ? 0 : size * scenes::power_of_ten(random, -16, -1),
          random));
    Mesh mesh = near.scene.mesh();
    mesh.set_rules(rules);
    CAPTURE(i, near.options.min_separation, near.options.gap_share);
    const TruncatedStep r = truncate_step(mesh, near.scene.x_t0, near.scene.x_t1, near.options);
    for (std::size_t p = 0; p < rules.planes.size(); ++p) {
      const HalfSpaceTruth truth(rules.planes[p], near.options.min_separation, near.options.norm);
      for (std::size_t v = 0; v < std::size_t(mesh.num_vertices()); ++v) {
        CAPTURE(p, v, r.share[v]);
        const RowVector3d x0 = near.scene.x_t0.row(Eigen::Index(v)),
                          x1 = near.scene.x_t1.row(Eigen::Index(v)), end = row(r.positions, v),
                          sum = x0 + row(r.displacements, v);
        const Rational start = truth.value(x0);
        if (oracle::sign(start) <= 0) {
          ++touching;
          CHECK(r.outcome == Outcome::initial_contact);
          CHECK((r.share[v] == 0 && end == x0));
        } else if (truth.side(start) <= 0) {
          ++within;
          CHECK(truth.value(end) >= start);
          CHECK(truth.value(sum) >= start);
        } else {
          CHECK(truth.side(truth.value(end)) > 0);
          CHECK(truth.side(truth.value(sum)) > 0);
          stopped += truth.side(truth.value(x1)) <= 0, moved += r.share[v] > 0;
        }
      }
    }
  }
  std::printf(
      "%d scenes: %zu vertices stopped before a plane, %zu touch at the start, %zu start within, %zu move\n",
      count, stopped, touching, within, moved);
  CHECK(stopped > std::size_t(count) / 4);
  CHECK(touching > 0);
  CHECK(within > 0);
}

TEST_CASE("a vertex that falls on a plane goes nearly all of its way there, others all of theirs",
          "[truncate_step]") {
  Eigen::MatrixXd x(2, 3), x_new(2, 3);
  x << 0, 0, 1, 5, 0, 1;
  x_new << 0, 0, -1, 5, 0, 2;
  CollisionRules rules;
  rules.planes = {{{0, 0, 2}, 0}};
  const Mesh mesh(x, Eigen::MatrixXi(0, 3), rules);
  TruncateOptions options;
  options.gap_share = 0.25;
  const TruncatedStep r = truncate_step(mesh, x, x_new, options);
  CHECK(r.outcome == Outcome::contact);
  REQUIRE(r.limiting);
  CHECK(r.limiting->kind == PairKind::vertex_plane);
  CHECK((r.limiting->a == 0 && r.limiting->b == 0));
  CHECK(std::fabs(r.positions[2] - 0.25) < 1e-12);
  CHECK(r.share[1] == 1);
  CHECK(r.stats.contacts.vertex_plane == 1);
}

TEST_CASE("a vertex that rests within its separation of a plane holds nobody up", "[truncate_step]") {
  Eigen::MatrixXd x(2, 3), x_new(2, 3);
  x << 0, 0, 0.1, 5, 0, 1;
  x_new << 0, 0, 0.1, 6, 0, 1;
  CollisionRules rules;
  rules.planes = {{{0, 0, 1}, 0}};
  TruncateOptions options;
  options.min_separation = 0.2;
  const TruncatedStep r = truncate_step(Mesh(x, Eigen::MatrixXi(0, 3), rules), x, x_new, options);
  CHECK((r.outcome == Outcome::free && r.kept == 1));
}
