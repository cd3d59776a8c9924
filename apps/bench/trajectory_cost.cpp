// What a body that turns adds to the step of a cloth that moves linearly, and what it costs by itself.
//   onset_trajectory_cost [repeats [case]]   with a case, from 0: that one alone, for a profiler
// Prints CPU milliseconds a call, one thread, median over repeats; the cases take turns in one run, and the
// first round is left out.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <onset/onset.hpp>
#include <optional>
#include <string>
#include <vector>

#include "files/text_lines.hpp"
#include "measure/timing.hpp"

namespace {

constexpr int kCloth = 100, kRings = 12, kSegments = 16;
constexpr double kPi = 3.14159265358979323846;

struct Surface {
  Eigen::MatrixXd x;
  Eigen::MatrixXi faces;
};

// n x n squares over [-1/2, 1/2]^2 at height z, with ripples.
Surface cloth(int n, double z) {
  Surface s;
  s.x.resize((n + 1) * (n + 1), 3);
  s.faces.resize(2 * n * n, 3);
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) {
      const double x = double(i) / n - 0.5, y = double(j) / n - 0.5;
      s.x.row(i * (n + 1) + j) << x, y, z + 0.02 * std::sin(9 * x + 2 * y) * std::cos(7 * y);
    }
  int f = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const int v = i * (n + 1) + j;
      s.faces.row(f++) << v, v + n + 1, v + n + 2;
      s.faces.row(f++) << v, v + n + 2, v + 1;
    }
  return s;
}

// An ellipsoid about the origin, so that it sweeps more than it fills when it turns.
Surface ellipsoid(double radius) {
  Surface s;
  s.x.resize(kRings * kSegments + 2, 3);
  for (int i = 0; i < kRings; ++i)
    for (int j = 0; j < kSegments; ++j) {
      const double a = kPi * (i + 1) / (kRings + 1), b = 2 * kPi * j / kSegments;
      s.x.row(i * kSegments + j) << radius * std::sin(a) * std::cos(b),
          0.6 * radius * std::sin(a) * std::sin(b), 0.6 * radius * std::cos(a);
    }
  s.x.bottomRows(2) << 0, 0, 0.6 * radius, 0, 0, -0.6 * radius;
  const int top = kRings * kSegments, bottom = top + 1;
  s.faces.resize(2 * kRings * kSegments, 3);
  int f = 0;
  for (int j = 0; j < kSegments; ++j) {
    const int k = (j + 1) % kSegments, last = (kRings - 1) * kSegments;
    s.faces.row(f++) << top, j, k;
    s.faces.row(f++) << bottom, last + k, last + j;
    for (int i = 0; i + 1 < kRings; ++i) {
      const int a = i * kSegments, b = a + kSegments;
      s.faces.row(f++) << a + j, b + j, b + k;
      s.faces.row(f++) << a + j, b + k, a + k;
    }
  }
  return s;
}

Surface joined(const Surface& a, const Surface& b) {
  Surface s;
  s.x.resize(a.x.rows() + b.x.rows(), 3), s.faces.resize(a.faces.rows() + b.faces.rows(), 3);
  s.x << a.x, b.x;
  s.faces << a.faces, (b.faces.array() + int(a.x.rows())).matrix();
  return s;
}

// A cloth of the first vertices, and a body of the others that turns.
struct Case {
  const char* name;
  Surface scene;
  int cloth;
  double angle;
  onset::Mesh mesh;
  std::vector<double> step{}, active{};
  double free = 0;

  Case(const char* n, Surface s, int of_cloth, double a)
      : name(n), scene(std::move(s)), cloth(of_cloth), angle(a), mesh(scene.x.rows(), scene.faces) {
    onset::CollisionRules rules;
    for (int v = 0; v < scene.x.rows(); ++v) rules.bodies.push_back(v >= cloth);
    rules.rigid_bodies = {false, true};
    rules.rigid_bodies.resize(scene.x.rows() > cloth ? 2 : 1);
    if (cloth == 0) rules.bodies.assign(std::size_t(scene.x.rows()), 0), rules.rigid_bodies = {true};
    mesh.set_rules(rules);
  }

  void run(int round) {
    onset::Options o;
    o.threads = 1;
    Eigen::MatrixXd x_t1 = scene.x;
    for (int v = 0; v < cloth; ++v)  // the cloth falls a little, differently each time
      x_t1.row(v) += 0.004 * Eigen::RowVector3d(std::sin(v + round), std::cos(2 * v - round), -1.5);
    onset::RigidTrajectory motion(scene.x, x_t1);
    if (scene.x.rows() > cloth) {
      const Eigen::RowVector3d centre = scene.x.bottomRows(scene.x.rows() - cloth).colwise().mean();
      motion.add_body(cloth, scene.x.rows(), {0, angle, 0.3 * angle}, {0, 0, 0}, centre.transpose());
    }
    const app::Stopwatch watch;
    const onset::StepResult r = onset::compute_collision_free_stepsize(mesh, motion, o);
    const double middle = watch.elapsed().cpu;
    const onset::ActiveSet set = onset::construct_active_set(mesh, motion, o);
    const double end = watch.elapsed().cpu;
    free = r.step;
    if (round == 0) return;
    step.push_back(1e3 * middle), active.push_back(1e3 * (end - middle));
  }
};

double median(const std::vector<double>& x) { return app::spread(x).median; }

}  // namespace

int main(int argc, char** argv) {
  const std::optional<std::int64_t> asked = argc > 1 ? app::parse_whole(argv[1]) : 40;
  const std::optional<std::int64_t> only = argc > 2 ? app::parse_whole(argv[2]) : -1;
  if (!asked || *asked < 1 || *asked > INT32_MAX || !only || *only < -1 || *only > 6) {
    std::fprintf(stderr, "usage: onset_trajectory_cost [REPEATS [CASE]]\n");
    return 2;
  }
  const Surface sheet = cloth(kCloth, 0);
  const int n = int(sheet.x.rows());
  const auto body = [](double z) {
    Surface s = ellipsoid(0.1);
    s.x.col(2).array() += z;
    return s;
  };
  std::vector<Case> cases;
  cases.reserve(7);
  cases.emplace_back("cloth alone", sheet, n, 0.0);
  cases.emplace_back("and a body that stands, far", joined(sheet, body(-1)), n, 0.0);
  cases.emplace_back("and a body that turns 0.1, far", joined(sheet, body(-1)), n, 0.1);
  cases.emplace_back("and a body that turns 3, far", joined(sheet, body(-1)), n, 3.0);
  cases.emplace_back("and a body that turns 0.1, close", joined(sheet, body(-0.15)), n, 0.1);
  cases.emplace_back("and a body that turns 3, close", joined(sheet, body(-0.15)), n, 3.0);
  cases.emplace_back("a body that turns 3, alone", body(0), 0, 3.0);
  for (int round = 0; round <= int(*asked); ++round)
    for (std::size_t i = 0; i < cases.size(); ++i)
      if (*only < 0 || *only == std::int64_t(i)) cases[i].run(round);
  if (*only >= 0) return 0;
  std::printf("%-36s %10s %6s %14s %6s %8s\n", "cloth of 20,000, body of 384 triangles", "step ms", "ratio",
              "active set ms", "ratio", "step");
  for (const Case& c : cases)
    std::printf("%-36s %10.3f %6.3f %14.3f %6.3f %8.4f\n", c.name, median(c.step),
                median(c.step) / median(cases[0].step), median(c.active),
                median(c.active) / median(cases[0].active), c.free);
}
