// What certainty costs: the active set of recorded steps at each Exactness, in one process, in turn.
//
//   onset_certainty_bench A B [A B ...]
//
// CPU seconds of one thread, the least of several rounds; relative tolerance 1e-8 and 1e-3.
//
//   onset_certainty_bench --once LEVEL A B
//
// One call at 1e-8 and nothing printed: to count instructions where time is too noisy.
#include <cstdio>
#include <cstring>
#include <vector>

#include "files/error.hpp"
#include "files/scene/scene.hpp"
#include "measure/timing.hpp"

namespace {

constexpr int kRounds = 7;
constexpr onset::Exactness kLevels[] = {onset::Exactness::conservative, onset::Exactness::certify,
                                        onset::Exactness::exact};

struct Measured {
  double seconds = INFINITY;
  std::size_t contacts = 0, certain = 0;
};

void measure(const app::Scene& scene, onset::Options options, Measured& m) {
  const app::Stopwatch watch;
  const onset::ActiveSet set = onset::construct_active_set(scene.mesh, scene.x_t0, scene.x_t1, options);
  m.seconds = std::min(m.seconds, watch.elapsed().cpu);
  m.contacts = set.size();
  m.certain = 0;
  for (const onset::Contact& c : set) m.certain += c.certainty != onset::Certainty::within_tolerance;
}

void compare(const char* name, const app::Scene& scene, double tolerance) {
  Measured m[3];
  onset::Options options;
  options.threads = 1;
  options.relative_tolerance = tolerance;
  for (int round = 0; round < kRounds; ++round)
    for (int level = 0; level < 3; ++level) {
      options.exactness = kLevels[level];
      measure(scene, options, m[level]);
    }
  std::printf("| %s | %.0e | %.1f | %zu | %+.1f %% | %zu of %zu | %+.1f %% | %zu of %zu |\n", name, tolerance,
              1e3 * m[0].seconds, m[0].contacts, 100 * (m[1].seconds / m[0].seconds - 1), m[1].certain,
              m[1].contacts, 100 * (m[2].seconds / m[0].seconds - 1), m[2].certain, m[2].contacts);
  std::fflush(stdout);
}

int count_once(const char* level, const char* x_t0, const char* x_t1) {
  const char* const names[] = {"conservative", "certify", "exact"};
  for (int i = 0; i < 3; ++i) {
    if (std::strcmp(level, names[i]) != 0) continue;
    const app::Scene scene = app::read_scene(x_t0, x_t1);
    onset::Options options;
    options.threads = 1;
    options.relative_tolerance = 1e-8;
    options.exactness = kLevels[i];
    Measured m;
    measure(scene, options, m);
    return 0;
  }
  std::fprintf(stderr, "onset_certainty_bench: no level '%s'\n", level);
  return 2;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc == 5 && std::strcmp(argv[1], "--once") == 0) return count_once(argv[2], argv[3], argv[4]);
  if (argc < 3 || argc % 2 == 0) {
    std::fprintf(stderr,
                 "usage: onset_certainty_bench A B [A B ...]\n"
                 "       onset_certainty_bench --once LEVEL A B\n");
    return 2;
  }
  std::printf("| step | tolerance | conservative ms | contacts | certify | certain | exact | certain |\n");
  std::printf("|---|---|---|---|---|---|---|---|\n");
  for (int i = 1; i < argc; i += 2) {
    const app::Scene scene = app::read_scene(argv[i], argv[i + 1]);
    for (const double tolerance : {1e-8, 1e-3}) compare(argv[i], scene, tolerance);
  }
} catch (const std::exception& error) {
  std::fprintf(stderr, "onset_certainty_bench: %s\n", error.what());
  return 1;
}
