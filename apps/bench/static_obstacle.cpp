// What a static obstacle adds to a cloth's step: out of reach and just below the cloth, static or not
// declared so.
//   onset_static_obstacle [repeats [only the case whose name begins so]]
// Prints CPU milliseconds a call, one thread, median over repeats, the obstacle's first call left out.
#include <algorithm>
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

constexpr int kCloth = 50, kObstacle = 158;  // squares along a side: 5,000 and 49,928 triangles

struct Sheet {
  Eigen::MatrixXd x_t0, x_t1;
  Eigen::MatrixXi faces;
};

// n x n squares over [-size, size]^2 at height z, with ripples of the height given.
Sheet sheet(int n, double size, double z, double ripple) {
  Sheet s;
  s.x_t0.resize((n + 1) * (n + 1), 3);
  s.faces.resize(2 * n * n, 3);
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) {
      const double x = size * (2.0 * i / n - 1), y = size * (2.0 * j / n - 1);
      s.x_t0.row(i * (n + 1) + j) << x, y, z + ripple * std::sin(9 * x + 2 * y) * std::cos(7 * y);
    }
  int f = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const int v = i * (n + 1) + j;
      s.faces.row(f++) << v, v + n + 1, v + n + 2;
      s.faces.row(f++) << v, v + n + 2, v + 1;
    }
  s.x_t1 = s.x_t0;
  return s;
}

Sheet joined(const Sheet& a, const Sheet& b) {
  Sheet s;
  const auto stack = [](const auto& top, const auto& bottom, auto& all) {
    all.resize(top.rows() + bottom.rows(), 3);
    all << top, bottom;
  };
  stack(a.x_t0, b.x_t0, s.x_t0), stack(a.x_t1, b.x_t1, s.x_t1);
  stack(a.faces, (b.faces.array() + int(a.x_t0.rows())).matrix().eval(), s.faces);
  return s;
}

// One case: its mesh, and the times of its calls so far.
struct Case {
  const char* name;
  Sheet scene;
  onset::Mesh mesh;
  std::vector<double> step{}, active{};
  int boxes_made = 0;
  onset::PairCounts candidates{};

  Case(const char* n, Sheet s, int static_from)
      : name(n), scene(std::move(s)), mesh(scene.x_t0.rows(), scene.faces) {
    if (static_from < 0) return;
    onset::CollisionRules rules;
    rules.static_vertices.assign(std::size_t(scene.x_t0.rows()), false);
    for (std::size_t v = std::size_t(static_from); v < rules.static_vertices.size(); ++v)
      rules.static_vertices[v] = true;
    mesh.set_rules(rules);
  }

  void run(int vertices_of_cloth, int round) {
    onset::Options o;
    o.threads = 1;
    for (int v = 0; v < vertices_of_cloth; ++v)  // the cloth falls a little, differently each time
      scene.x_t1.row(v) =
          scene.x_t0.row(v) + 0.01 * Eigen::RowVector3d(std::sin(v + round), std::cos(2 * v - round), -1.5);
    const app::Stopwatch watch;
    const onset::StepResult r = onset::compute_collision_free_stepsize(mesh, scene.x_t0, scene.x_t1, o);
    const double middle = watch.elapsed().cpu;
    const onset::ActiveSet set = onset::construct_active_set(mesh, scene.x_t0, scene.x_t1, o);
    const double end = watch.elapsed().cpu;
    boxes_made += r.stats.made_static_boxes + set.stats.made_static_boxes;
    candidates = set.stats.candidates;
    if (round == 0) return;
    step.push_back(1e3 * middle), active.push_back(1e3 * (end - middle));
  }
};

double median(const std::vector<double>& x) { return app::spread(x).median; }

}  // namespace

int main(int argc, char** argv) {
  const std::optional<std::int64_t> asked = argc > 1 ? app::parse_whole(argv[1]) : 100;
  if (!asked || *asked < 1 || *asked > INT32_MAX) {
    std::fprintf(stderr, "usage: onset_static_obstacle [REPEATS [NAME]]\n");
    return 2;
  }
  const int repeats = int(*asked);
  const Sheet cloth = sheet(kCloth, 0.5, 0, 0.02);
  const int vertices = int(cloth.x_t0.rows());
  const Sheet far = joined(cloth, sheet(kObstacle, 1, -1, 0.1)),
              near = joined(cloth, sheet(kObstacle, 1, -0.085, 0.1));
  std::vector<Case> cases;
  cases.reserve(5);
  cases.emplace_back("cloth alone", cloth, -1);
  cases.emplace_back("static, out of reach", far, vertices);
  cases.emplace_back("not declared static, out of reach", far, -1);
  cases.emplace_back("static, close", near, vertices);
  cases.emplace_back("not declared static, close", near, -1);
  if (argc > 2) {
    const auto other = [&](const Case& c) { return std::string(c.name).rfind(argv[2], 0) != 0; };
    cases.erase(std::remove_if(cases.begin(), cases.end(), other), cases.end());
  }
  for (int round = 0; round <= repeats; ++round)
    for (Case& c : cases) c.run(vertices, round);
  std::printf("%-34s %10s %6s %14s %6s %11s %12s\n", "cloth of 5,000, obstacle of 49,928", "step ms", "ratio",
              "active set ms", "ratio", "boxes made", "candidates");
  for (const Case& c : cases)
    std::printf("%-34s %10.3f %6.2f %14.3f %6.2f %11d %12lld\n", c.name, median(c.step),
                median(c.step) / median(cases[0].step), median(c.active),
                median(c.active) / median(cases[0].active), c.boxes_made,
                static_cast<long long>(c.candidates.total()));
}
