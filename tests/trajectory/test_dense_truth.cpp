// Steps and active sets of turning bodies against densely sampled paths: never late, and early by no more
// than the tolerance.
#include <cmath>
#include <cstdio>
#include <onset/onset.hpp>

#include "tests/catch.hpp"
#include "tests/fuzz.hpp"
#include "tests/scenes/meshes.hpp"
#include "tests/trajectory/dense_truth.hpp"

namespace onset::tests {
namespace {

using scenes::coin;
using scenes::integer;
using scenes::power_of_ten;
using scenes::Random;
using scenes::uniform;

constexpr double kPi = 3.14159265358979323846, kBlur = 1e-10;

Eigen::Vector3d vector(Random& random, double size) {
  return {uniform(random, -size, size), uniform(random, -size, size), uniform(random, -size, size)};
}

// From 10 to 350 degrees about an axis that passes within `far` of a centre, with or without a translation.
RigidMotion random_motion(Random& random, double far) {
  const double angle = uniform(random, 10, 350) * kPi / 180;
  Eigen::Vector3d axis = coin(random) ? vector(random, 1) : Eigen::Vector3d::Unit(integer(random, 0, 2));
  return {axis.normalized() * angle, coin(random) ? vector(random, 0.5) : Eigen::Vector3d::Zero(),
          coin(random) ? vector(random, far) : Eigen::Vector3d::Zero()};
}

struct PathScene {
  TurningPaths paths;
  Eigen::MatrixXi edges, faces;
};

// The first side turns; the other stands, moves, or turns.
PathScene random_pair(Random& random, PairKind kind) {
  PathScene s;
  const int first = kind == PairKind::vertex_face ? 1 : 2;
  s.paths.x_t0.resize(4, 3);
  for (int v = 0; v < 4; ++v) s.paths.x_t0.row(v) = vector(random, 1);
  s.paths.x_t1 = s.paths.x_t0;
  s.paths.bodies = {random_motion(random, 1)};
  const bool swapped = coin(random);
  for (int v = 0; v < 4; ++v) s.paths.body.push_back((v < first) != swapped ? 0 : -1);
  const int other = integer(random, 0, 2);
  if (other == 2) s.paths.bodies.push_back(random_motion(random, 1));
  for (int v = 0; v < 4; ++v) {
    if (s.paths.body[std::size_t(v)] == 0) continue;
    if (other == 1) s.paths.x_t1.row(v) += vector(random, 1);
    if (other == 2) s.paths.body[std::size_t(v)] = 1;
  }
  s.edges.resize(kind == PairKind::vertex_face ? 0 : 2, 2);
  s.faces.resize(kind == PairKind::vertex_face ? 1 : 0, 3);
  if (kind == PairKind::vertex_face)
    s.faces << 1, 2, 3;
  else
    s.edges << 0, 1, 2, 3;
  return s;
}

struct Tally {
  int contacts = 0, late = 0, proved = 0, reported = 0;
  double earliest = 0;  // in tolerances
};

void check_row(const TurningPaths& paths, const Contact& c, double separation, const Truth& truth,
               Tally& tally) {
  ++tally.reported;
  const double gap = double(distance(c.kind, paths.at(c.vertices, Long(c.toi)))) - separation;
  CAPTURE(c.toi, c.toi_hi, gap, c.tolerance);
  if (c.toi > 0) REQUIRE(gap <= c.tolerance + kBlur);
  if (truth.first && c.toi > double(*truth.first) + kBlur) ++tally.late;
  if (c.certainty != Certainty::certain) return;
  ++tally.proved;
  REQUIRE(c.toi_hi > c.toi);
  if (truth.first) REQUIRE(c.toi_hi >= double(*truth.first) - kBlur);
  REQUIRE(truth.least <= separation + kBlur);
}

}  // namespace

TEST_CASE("pairs with a part that turns are never late, and early by the tolerance at most", "[trajectory]") {
  Random random(41);
  Tally tally;
  int free = 0;
  for (int i = 0; i < fuzz(1000); ++i) {
    const PairKind kind = coin(random) ? PairKind::vertex_face : PairKind::edge_edge;
    const PathScene s = random_pair(random, kind);
    const Mesh mesh(s.paths.x_t0, complete_edges(s.edges, s.faces), s.faces);
    const RigidTrajectory trajectory = s.paths.trajectory();
    Options options;
    options.min_separation = coin(random) ? power_of_ten(random, -4, -1) : 0;
    options.tolerance = power_of_ten(random, -8, -4);
    const std::array<int, 4> v{0, 1, 2, 3};
    const Truth truth = first_contact(s.paths, kind, v, options.min_separation, 500);
    const ActiveSet set = construct_active_set(mesh, trajectory, options);
    const StepResult step = compute_collision_free_stepsize(mesh, trajectory, options);
    CAPTURE(i, int(kind), options.min_separation, *options.tolerance, step.step, step.toi);
    REQUIRE(set.size() <= 1);
    REQUIRE(is_step_collision_free(mesh, trajectory, options) == set.empty());
    REQUIRE((step.toi <= 1) == !set.empty());
    REQUIRE(step.step <= step.toi);
    if (truth.first) {
      ++tally.contacts;
      CAPTURE(double(*truth.first));
      REQUIRE(set.size() == 1);
      if (step.step > double(*truth.first) + kBlur) ++tally.late;
    }
    if (truth.least > options.min_separation + *options.tolerance + 1e-6) {
      REQUIRE(set.empty());
      ++free;
    }
    if (set.empty()) continue;
    REQUIRE(set[0].toi == step.toi);
    REQUIRE(set[0].tolerance <= *options.tolerance * (1 + 1e-9) + 1e-13);
    if (distance(kind, s.paths.at(v, 0.0)) > options.min_separation + 1e-12) REQUIRE(step.step > 0);
    check_row(s.paths, set[0], options.min_separation, truth, tally);
  }
  std::printf("pairs: %d contacts, %d late, %d free, %d reported, %d of these proved\n", tally.contacts,
              tally.late, free, tally.reported, tally.proved);
  CHECK(tally.late == 0);
  CHECK(tally.proved > tally.contacts / 3);
}

namespace {

// Cubes that turn about each other's places, some that only move, and some that stand.
PathScene random_scene(Random& random) {
  PathScene s;
  scenes::Scene all;
  const int count = integer(random, 2, 4);
  for (int b = 0; b < count; ++b) {
    scenes::Scene cube = scenes::cube();
    cube.x_t0 *= uniform(random, 0.2, 0.45);
    const Eigen::AngleAxisd q(uniform(random, 0, 3), vector(random, 1).normalized());
    cube.x_t0 = (cube.x_t0 * q.toRotationMatrix()).eval();
    const Eigen::Vector3d place(1.7 * (b % 2), 1.7 * (b / 2), uniform(random, -0.3, 0.3));
    cube.x_t0.rowwise() += place.transpose();
    cube.x_t1 = cube.x_t0;
    all = b == 0 ? cube : scenes::joined(all, cube);
    const bool turns = b == 0 || coin(random);
    const Eigen::Vector3d step = coin(random) ? vector(random, 1) : Eigen::Vector3d::Zero();
    for (int v = 0; v < 8; ++v) {
      s.paths.body.push_back(turns ? int(s.paths.bodies.size()) : -1);
      if (!turns) all.x_t1.row(8 * b + v) += step;
    }
    if (!turns) continue;
    RigidMotion m = random_motion(random, 1.5);
    if (coin(random)) m.centre = place;
    s.paths.bodies.push_back(m);
  }
  s.paths.x_t0 = all.x_t0, s.paths.x_t1 = all.x_t1, s.faces = all.faces;
  return s;
}

}  // namespace

TEST_CASE("scenes with bodies that turn are never late", "[trajectory]") {
  Random random(42);
  Tally tally;
  int free = 0;
  for (int i = 0; i < fuzz(20); ++i) {
    const PathScene s = random_scene(random);
    const Mesh mesh(s.paths.x_t0, s.faces);
    const RigidTrajectory trajectory = s.paths.trajectory();
    Options options;
    options.min_separation = coin(random) ? 0.01 : 0;
    options.tolerance = 1e-5;
    const ActiveSet set = construct_active_set(mesh, trajectory, options);
    const StepResult step = compute_collision_free_stepsize(mesh, trajectory, options);
    CAPTURE(i, step.step, step.toi, set.size());
    std::size_t row = 0;
    Long first = INFINITY;
    const auto ask = [&](PairKind kind, int a, int b) {
      const Pair pair = [&] {
        Pair p;
        p.kind = kind, p.a = a, p.b = b;
        if (kind == PairKind::vertex_face)
          p.vertices = {a, mesh.face(b)[0], mesh.face(b)[1], mesh.face(b)[2]};
        else
          p.vertices = {mesh.edge(a)[0], mesh.edge(a)[1], mesh.edge(b)[0], mesh.edge(b)[1]};
        return p;
      }();
      if (pair.vertices[0] / 8 == pair.vertices[3] / 8) return;  // of one cube
      const Truth truth = first_contact(s.paths, kind, pair.vertices, options.min_separation, 150);
      const bool listed = row < set.size() && set[row].kind == kind && set[row].a == a && set[row].b == b;
      CAPTURE(int(kind), a, b, listed);
      if (truth.first) {
        ++tally.contacts;
        first = std::min(first, *truth.first);
        REQUIRE(listed);
      }
      if (truth.least > options.min_separation + 1e-4) REQUIRE(!listed);
      if (listed) check_row(s.paths, set[row++], options.min_separation, truth, tally);
    };
    for (int v = 0; v < mesh.num_vertices(); ++v)
      for (int f = 0; f < mesh.num_faces(); ++f) ask(PairKind::vertex_face, v, f);
    for (int e = 0; e < mesh.num_edges(); ++e)
      for (int g = e + 1; g < mesh.num_edges(); ++g) ask(PairKind::edge_edge, e, g);
    REQUIRE(row == set.size());
    if (step.step > double(first) + kBlur) ++tally.late;
    REQUIRE((step.step < 1 || set.empty()));
    if (set.earliest() != nullptr) REQUIRE(step.toi == set.earliest()->toi);
    free += set.empty();
  }
  std::printf("scenes: %d free, %d contacts, %d late, %d reported, %d of these proved\n", free,
              tally.contacts, tally.late, tally.reported, tally.proved);
  CHECK(tally.late == 0);
  CHECK(tally.contacts > 0);
}

}  // namespace onset::tests
