// Steps and active sets of scenes in the plane, for scripts/planar_steps_beside_ipctk.py.
//
//   onset_planar_steps FILE REPEATS
//
// FILE: #V and #E as int64, positions at both ends (#V x 2 doubles each, row by row), edges (#E x 2 int32).
// Prints one line: step, toi, contacts, and the medians of the CPU seconds of the step, of the active set
// (certify), and of the active set where real contacts are not told (conservative).
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <onset/onset.hpp>
#include <vector>

#include "measure/timing.hpp"

namespace {

struct Scene {
  Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> x_t0, x_t1;
  Eigen::Matrix<std::int32_t, Eigen::Dynamic, 2, Eigen::RowMajor> edges;
};

template <class T>
void read(std::ifstream& file, T* to, std::int64_t count) {
  file.read(reinterpret_cast<char*>(to), std::streamsize(count * std::int64_t(sizeof(T))));
}

Scene read_scene(const char* path) {
  std::ifstream file(path, std::ios::binary);
  std::int64_t sizes[2] = {};
  read(file, sizes, 2);
  Scene s;
  s.x_t0.resize(sizes[0], 2), s.x_t1.resize(sizes[0], 2), s.edges.resize(sizes[1], 2);
  read(file, s.x_t0.data(), 2 * sizes[0]), read(file, s.x_t1.data(), 2 * sizes[0]);
  read(file, s.edges.data(), 2 * sizes[1]);
  if (!file) std::fprintf(stderr, "%s: cut off\n", path), std::exit(1);
  return s;
}

// The median of `repeats` runs, of which each is as many calls as take a millisecond.
template <class F>
double median_seconds(int repeats, const F& call) {
  call();
  int calls = 1;
  const auto seconds = [&] {
    const app::Stopwatch watch;
    for (int i = 0; i < calls; ++i) call();
    return watch.elapsed().cpu;
  };
  while (seconds() <= 1e-3) calls *= 2;
  std::vector<double> times;
  for (int r = 0; r < repeats; ++r) times.push_back(seconds() / calls);
  return app::spread(times).median;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return std::fprintf(stderr, "usage: onset_planar_steps FILE REPEATS\n"), 2;
  const Scene s = read_scene(argv[1]);
  const int repeats = std::max(1, std::atoi(argv[2]));
  const onset::Mesh mesh = onset::Mesh::in_plane(s.x_t0.rows(), s.edges);
  onset::Options options;
  options.threads = 1;
  onset::StepResult step;
  onset::ActiveSet set;
  const double of_step = median_seconds(
      repeats, [&] { step = onset::compute_collision_free_stepsize(mesh, s.x_t0, s.x_t1, options); });
  double of_set[2];
  for (const bool certify : {false, true}) {
    options.exactness = certify ? onset::Exactness::certify : onset::Exactness::conservative;
    of_set[certify] =
        median_seconds(repeats, [&] { set = onset::construct_active_set(mesh, s.x_t0, s.x_t1, options); });
  }
  std::printf("%.17g %.17g %zu %.9g %.9g %.9g\n", step.step, step.toi, set.size(), of_step, of_set[1],
              of_set[0]);
  return 0;
}
