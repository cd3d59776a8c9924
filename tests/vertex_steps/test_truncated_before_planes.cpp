// Planes of the mesh keep what truncate_step returns in front of them, exactly, and the pairs stay apart too.
#include <Eigen/Geometry>
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

TEST_CASE("a vertex within its separation of a plane slides along it, as a step lets it", "[truncate_step]") {
  Eigen::MatrixXd x(1, 3), x_new(1, 3);
  x << 0, 0, 0.05;
  x_new << 1, 0, 0.05;
  CollisionRules rules;
  rules.planes = {{{0, 0, 1}, 0}};
  const Mesh mesh(x, Eigen::MatrixXi(0, 3), rules);
  TruncateOptions options;
  options.min_separation = 0.1;
  CHECK(compute_collision_free_stepsize(mesh, x, x_new, options).step == 1);
  const TruncatedStep r = truncate_step(mesh, x, x_new, options);
  CHECK((r.share[0] == 1 && r.outcome == Outcome::free));
  x_new(0, 2) = std::nextafter(0.05, 0);
  CHECK(truncate_step(mesh, x, x_new, options).share[0] == 0);
}

TEST_CASE("a vertex within its separation goes all its way where it comes no closer to the plane, exactly",
          "[oracle][property]") {
  scenes::Random random(oracle::fuzz_seed() * 1000 + 91);
  int slide = 0, all = 0, stopped = 0, part = 0;
  for (int i = 0; i < oracle::fuzz(2000); ++i) {
    Eigen::MatrixXd x(1, 3), x_new(1, 3);
    CollisionRules rules;
    Plane plane;
    for (std::size_t a = 0; a < 3; ++a) plane.normal[a] = scenes::integer(random, -3, 3);
    plane.normal[random() % 3] = scenes::coin(random) ? 1 : scenes::uniform(random, 0.1, 1);
    for (Eigen::Index a = 0; a < 3; ++a) x(0, a) = scenes::uniform(random, -1, 1);
    const RowVector3d n(plane.normal[0], plane.normal[1], plane.normal[2]);
    plane.offset = x.row(0).dot(n) - n.norm() * scenes::power_of_ten(random, -14, -2);
    RowVector3d along =
        n.cross(RowVector3d(scenes::integer(random, -9, 9), scenes::integer(random, -9, 9), 1));
    along *= 0x1p-6;
    if (scenes::coin(random)) along *= scenes::unit(random);
    if (scenes::coin(random)) x = (x * 0x1p20).array().round() * 0x1p-20;  // and all is exact
    x_new.row(0) = x.row(0) + along;
    if (scenes::integer(random, 0, 3) == 0) x_new.row(0) += n * scenes::power_of_ten(random, -18, -3);
    rules.planes = {plane};
    TruncateOptions o;
    o.min_separation = 0.1;
    const Mesh mesh(x, Eigen::MatrixXi(0, 3), rules);
    const HalfSpaceTruth truth(plane, o.min_separation, o.norm);
    const Rational start = truth.value(x.row(0)), end = truth.value(x_new.row(0)),
                   sum = truth.value(RowVector3d(x + (x_new - x)));
    if (oracle::sign(start) <= 0) continue;
    const TruncatedStep r = truncate_step(mesh, x, x_new, o);
    CAPTURE(i, r.share[0]);
    slide += end == start, all += r.share[0] == 1, stopped += r.share[0] == 0;
    CHECK((r.share[0] == 1) == (end >= start && sum >= start));
    if (end < start) CHECK(r.share[0] == 0);
    part += end >= start && r.share[0] < 1;
    CHECK(truth.value(row(r.positions, 0)) >= start);
    CHECK(truth.value(RowVector3d(x + row(r.displacements, 0))) >= start);
  }
  std::printf("%d slide exactly, %d go all their way, %d a part of it for their sum, %d stay\n", slide, all,
              part, stopped);
  CHECK(slide > oracle::fuzz(2000) / 8);
}

TEST_CASE("a plane beyond all doubles holds nobody up", "[truncate_step]") {
  Eigen::MatrixXd x(1, 3), x_new(1, 3);
  x << 0, 0, 1;
  x_new << 1, 0, -1;
  CollisionRules rules;
  rules.planes = {{{0, 0, 1e-20}, -1e300}};
  for (const double share : {0.0, 0.1}) {
    TruncateOptions options;
    options.gap_share = share;
    const TruncatedStep r = truncate_step(Mesh(x, Eigen::MatrixXi(0, 3), rules), x, x_new, options);
    CHECK((r.share[0] == 1 && r.outcome == Outcome::free));
  }
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
