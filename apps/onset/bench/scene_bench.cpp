#include "onset/bench/scene_bench.hpp"

#include <array>
#include <cstring>
#include <functional>
#include <stdexcept>

#include "measure/system.hpp"

namespace app {
namespace {

// One of the library's calls with what is measured of it.
struct Call {
  std::function<onset::Stats()>
      run;                      // its result is kept until the next run, so that freeing it is not measured
  std::function<void()> check;  // not measured
  std::vector<double> wall, cpu, broad, narrow;
  std::optional<std::int64_t> peak;

  void measure() {
    const Stopwatch watch;
    const onset::Stats stats = run();
    const Seconds seconds = watch.elapsed();
    wall.push_back(seconds.wall);
    cpu.push_back(seconds.cpu);
    broad.push_back(stats.seconds_broad);
    narrow.push_back(stats.seconds_narrow);
    check();
  }
  CallCost cost() const { return {spread(wall), spread(cpu), spread(broad), spread(narrow), peak}; }
};

std::uint64_t mix(std::uint64_t hash, std::uint64_t word) {
  for (int byte = 0; byte < 8; ++byte) hash = (hash ^ (word >> (8 * byte) & 0xff)) * 0x100000001b3u;
  return hash;
}

std::uint64_t bits(double x) {
  std::uint64_t word;
  std::memcpy(&word, &x, sizeof word);
  return word;
}

}  // namespace

std::uint64_t hash_of(const onset::ActiveSet& set) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const onset::Contact& contact : set) {
    hash = mix(hash, std::uint64_t(contact.kind) << 8 | std::uint64_t(contact.outcome));
    hash = mix(hash, std::uint64_t(std::uint32_t(contact.a)) << 32 | std::uint32_t(contact.b));
    hash = mix(hash, bits(contact.toi));
  }
  return hash;
}

double SceneCost::narrow_ns_a_candidate() const {
  const auto candidates = stats.candidates.total();
  if (candidates == 0) return 0;
  const double share = active_set.narrow.median / active_set.wall.median;
  return 1e9 * share * active_set.cpu.median / double(candidates);
}

double SceneCost::checks_a_hit() const {
  return stats.contacts.total() ? double(stats.checks) / double(stats.contacts.total()) : 0;
}

SceneCost bench_scene(const Scene& scene, const onset::Options& given, int repeats) {
  onset::Options options = given;
  options.hold_candidates = false;  // repeated calls are to cost what the first would, memory apart
  onset::ActiveSet set;
  onset::StepResult step;
  onset::Candidates candidates;
  std::optional<std::uint64_t> hash;
  const auto same_set = [&] {
    if (hash_of(set) != hash.value_or(hash_of(set)))
      throw std::runtime_error("two runs gave different active sets");
    hash = hash_of(set);
  };
  const auto nothing = [] {};
  const auto run_set = [&] {
    return (set = onset::construct_active_set(scene.mesh, scene.x_t0, scene.x_t1, options)).stats;
  };
  const auto run_step = [&] {
    return (step = onset::compute_collision_free_stepsize(scene.mesh, scene.x_t0, scene.x_t1, options)).stats;
  };
  const auto run_pairs = [&] {
    return (candidates = onset::count_candidates(scene.mesh, scene.x_t0, scene.x_t1, options)).stats;
  };
  std::array<Call, 3> calls{{{run_set, same_set, {}, {}, {}, {}, {}},
                             {run_step, nothing, {}, {}, {}, {}, {}},
                             {run_pairs, nothing, {}, {}, {}, {}, {}}}};
  for (Call& call : calls) {
    const auto once = [&] { repeats ? void(call.run()) : call.measure(); };
    call.peak = peak_bytes(once);
  }
  for (int i = 0; i < repeats; ++i)
    for (Call& call : calls) call.measure();
  onset::Stats stats = set.stats;
  stats.swept = candidates.counts;
  return {calls[0].cost(), calls[1].cost(), calls[2].cost(), stats, step, *hash};
}

}  // namespace app
