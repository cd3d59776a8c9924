// What a plane adds to a step, an active set and a line search: one scene with a plane and without, by turns.
//   onset_plane_cost [VERTICES [REPEATS]]
// Prints CPU milliseconds a call, one thread, median over repeats, and the median of the ratios of
// neighbours.
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

struct Cloths {
  Eigen::MatrixXd x_t0, x_t1;
  Eigen::MatrixXi faces;
};

// Four layers of n x n vertices over [-1, 1]^2, with ripples, that fall onto one another by a little.
Cloths layered(int n) {
  constexpr int kLayers = 4;
  Cloths s;
  s.x_t0.resize(kLayers * n * n, 3);
  s.faces.resize(kLayers * 2 * (n - 1) * (n - 1), 3);
  int v = 0, f = 0;
  for (int layer = 0; layer < kLayers; ++layer)
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j, ++v) {
        const double x = 2.0 * i / (n - 1) - 1, y = 2.0 * j / (n - 1) - 1;
        s.x_t0.row(v) << x, y, 1.5 / n * layer + 0.02 * std::sin(9 * x + 2 * y) * std::cos(7 * y);
        if (i + 1 == n || j + 1 == n) continue;
        s.faces.row(f++) << v, v + n, v + n + 1;
        s.faces.row(f++) << v, v + n + 1, v + 1;
      }
  s.x_t1 = s.x_t0;
  for (int w = 0; w < v; ++w)
    s.x_t1.row(w) += 0.5 / n * Eigen::RowVector3d(std::sin(w), std::cos(2 * w), -1.5);
  return s;
}

// CPU milliseconds of each call, a row a round.
struct Times {
  std::vector<double> step, active, search;
};

void run(const onset::Mesh& mesh, const Cloths& s, Times& times) {
  onset::LineSearchOptions o;
  o.threads = 1;
  const app::Stopwatch watch;
  onset::compute_collision_free_stepsize(mesh, s.x_t0, s.x_t1, o);
  const double step = watch.elapsed().cpu;
  onset::construct_active_set(mesh, s.x_t0, s.x_t1, o);
  const double active = watch.elapsed().cpu;
  onset::LineSearch(mesh, s.x_t0, s.x_t1 - s.x_t0, o).largest_step();
  times.step.push_back(1e3 * step), times.active.push_back(1e3 * (active - step));
  times.search.push_back(1e3 * (watch.elapsed().cpu - active));
}

onset::Mesh with_plane(const Cloths& s, double height) {
  onset::CollisionRules rules;
  rules.planes.push_back({{0, 0, 1}, height});
  return onset::Mesh(s.x_t0.rows(), s.faces, rules);
}

void print(const char* plane, const char* call, const std::vector<double>& without,
           const std::vector<double>& with) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < with.size(); ++i) ratios.push_back(with[i] / without[i]);
  std::printf("%-34s %-12s %9.3f ms without, %9.3f with, ratio %.4f\n", plane, call,
              app::spread(without).median, app::spread(with).median, app::spread(ratios).median);
}

}  // namespace

int main(int argc, char** argv) {
  const std::optional<std::int64_t> vertices = argc > 1 ? app::parse_whole(argv[1]) : 100000;
  const std::optional<std::int64_t> repeats = argc > 2 ? app::parse_whole(argv[2]) : 15;
  if (!vertices || *vertices < 64 || *vertices > 100'000'000 || !repeats || *repeats < 1) {
    std::fprintf(stderr, "usage: onset_plane_cost [VERTICES [REPEATS]]\n");
    return 2;
  }
  const Cloths s = layered(int(std::sqrt(double(*vertices) / 4)));
  const double lowest = s.x_t0.col(2).minCoeff();
  const onset::Mesh none(s.x_t0.rows(), s.faces);
  std::printf("%td vertices, %td faces\n", s.x_t0.rows(), s.faces.rows());
  const std::pair<const char*, double> heights[] = {{"a plane out of reach", lowest - 1},
                                                    {"a plane that some reach", lowest - 1e-4},
                                                    {"a plane just below the lowest", lowest - 1e-7}};
  for (const auto& [name, height] : heights) {
    const onset::Mesh with = with_plane(s, height);
    Times a, b;
    for (std::int64_t i = 0; i <= *repeats; ++i) {
      if (i == 1) a = b = {};  // the first round warms up
      run(none, s, a), run(with, s, b);
    }
    print(name, "step", a.step, b.step);
    print(name, "active set", a.active, b.active);
    print(name, "line search", a.search, b.search);
  }
}
