#include "onset/bench/kernel_bench.hpp"

#include <stdexcept>

#include "onset/bench/scene_bench.hpp"
#include "onset/results/report.hpp"

namespace app {
namespace {

struct Way {
  const char* name;
  onset::Options options;
  std::vector<double> cpu = {};
};

// A call with a set that the machine lacks throws before anything else is looked at.
bool can_run(const onset::Options& options) {
  const onset::Mesh nothing(0, Faces(0, 3));
  const Points none(0, 3);
  try {
    onset::construct_active_set(nothing, none, none, options);
  } catch (const std::invalid_argument&) {
    return false;
  }
  return true;
}

std::vector<Way> ways_of(const onset::Options& given) {
  using Set = onset::InstructionSet;
  std::vector<Way> ways;
  for (const auto& [name, set] :
       {std::pair{"scalar", Set::scalar}, std::pair{"avx2", Set::avx2}, std::pair{"avx512", Set::avx512}}) {
    onset::Options options = given;
    options.instruction_set = set, options.hold_candidates = false;
    if (can_run(options)) ways.push_back({name, options});
  }
  return ways;
}

// `answer` is a number that tells answers apart.
template <class Call>
std::vector<KernelCost::OfCall> bench_call(std::vector<Way> ways, int rounds, const Call& answer) {
  const auto expected = answer(ways.front().options);
  for (int round = -1; round < rounds; ++round)  // the first warms up
    for (std::size_t i = 0; i < ways.size(); ++i) {
      Way& way = ways[(i + std::size_t(round + 1)) % ways.size()];
      const Stopwatch watch;
      const auto given = answer(way.options);
      if (round >= 0) way.cpu.push_back(watch.elapsed().cpu);
      if (given != expected) throw std::runtime_error(std::string(way.name) + " gave another answer");
    }
  std::vector<KernelCost::OfCall> costs;
  for (const Way& way : ways) {
    std::vector<double> times;
    for (std::size_t i = 0; i < way.cpu.size(); ++i) times.push_back(ways.front().cpu[i] / way.cpu[i]);
    costs.push_back({spread(way.cpu), spread(times)});
  }
  return costs;
}

Json json_of(const KernelCost::OfCall& c) {
  return {{"cpu", spread_json(c.cpu)}, {"times", spread_json(c.times)}};
}

std::string row(const char* name, const std::string& set, const KernelCost::OfCall& c) {
  return format("  %-12s %-8s %10.3f [%.3f, %.3f] %8.2f [%.2f, %.2f]\n", name, set.c_str(),
                1e3 * c.cpu.median, 1e3 * c.cpu.least, 1e3 * c.cpu.most, c.times.median, c.times.least,
                c.times.most);
}

}  // namespace

std::vector<KernelCost> bench_kernels(const Scene& scene, const onset::Options& options, int rounds) {
  const std::vector<Way> ways = ways_of(options);
  const auto sets = bench_call(ways, rounds, [&](const onset::Options& o) {
    return hash_of(onset::construct_active_set(scene.mesh, scene.x_t0, scene.x_t1, o));
  });
  const auto steps = bench_call(ways, rounds, [&](const onset::Options& o) {
    return onset::compute_collision_free_stepsize(scene.mesh, scene.x_t0, scene.x_t1, o).step;
  });
  std::vector<KernelCost> costs;
  for (std::size_t i = 0; i < ways.size(); ++i) costs.push_back({ways[i].name, sets[i], steps[i]});
  return costs;
}

Json kernels_json(const std::vector<KernelCost>& costs) {
  Json json = Json::array();
  for (const KernelCost& c : costs)
    json.push_back(
        {{"instruction_set", c.name}, {"active_set", json_of(c.active_set)}, {"step", json_of(c.step)}});
  return json;
}

std::string describe(const std::vector<KernelCost>& costs) {
  std::string text = "instruction sets, CPU ms: median [least, most], times the scalar text's speed\n";
  for (const KernelCost& c : costs) text += row("active set", c.name, c.active_set);
  for (const KernelCost& c : costs) text += row("step size", c.name, c.step);
  return text + "\n";
}

}  // namespace app
