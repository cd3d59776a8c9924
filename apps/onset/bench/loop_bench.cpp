#include "onset/bench/loop_bench.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "onset/bench/scene_bench.hpp"
#include "onset/results/report.hpp"

namespace app {
namespace {

constexpr int kFirstCalls = 3;  // which positions are compared with, and pairs held in

double usual_edge(const Scene& scene) {
  std::vector<double> lengths;
  for (std::ptrdiff_t e = 0; e < scene.mesh.num_edges(); ++e) {
    const auto [a, b] = scene.mesh.edge(e);
    lengths.push_back((scene.x_t0.row(a) - scene.x_t0.row(b)).norm());
  }
  return spread(lengths).median;
}

// A smooth field that is another in each call, at most 1.
double field(double along, int call, int axis) {
  return std::sin(0.05 * along + 1.3 * call + 2.1 * axis) * std::cos(0.7 * call + axis);
}

// Both ends of call k: all that may move is shifted, and so is the end of its motion.
struct Positions {
  Points x_t0, x_t1;
};
Positions positions_of(const Scene& scene, const LoopSettings& settings, double edge, int call) {
  Positions p{scene.x_t0, scene.x_t1};
  const std::vector<bool>& fixed = scene.mesh.rules().static_vertices;
  for (Eigen::Index v = 0; v < p.x_t0.rows(); ++v)
    for (Eigen::Index a = 0; a < 3; ++a) {
      if (!fixed.empty() && fixed[std::size_t(v)]) continue;
      const double along = scene.x_t0(v, (a + 1) % 3) / edge, by = 0.5 * settings.change * edge;
      p.x_t0(v, a) = scene.x_t0(v, a) + by * field(along, call, int(a));
      p.x_t1(v, a) = p.x_t0(v, a) + settings.motion * (scene.x_t1(v, a) - scene.x_t0(v, a)) +
                     0.5 * by * field(along, call + 100, int(a));
    }
  return p;
}

struct Pause {
  std::vector<char> memory;
  void operator()() {
    for (std::size_t i = 0; i < memory.size(); i += 64) memory[i] = char(memory[i] + 1);
  }
};

// One way to call: with pairs held, or without, on a mesh of its own.
struct Way {
  onset::Mesh mesh;
  onset::Options options;
  std::vector<double> cpu;
  int served = 0;
  template <class Call>
  auto time(const Call& call, Pause& pause, bool counts) {
    pause();
    const Stopwatch watch;
    auto result = call(mesh, options);
    if (counts) cpu.push_back(watch.elapsed().cpu);
    served += counts && std::strcmp(result.stats.broad_phase, "held") == 0;
    return result;
  }
};

template <class Call, class Same>
LoopCost::OfCall bench_calls(const Scene& scene, const onset::Options& options, const LoopSettings& settings,
                             const Call& call, const Same& same) {
  std::array<Way, 2> ways{{{scene.mesh, options, {}, 0}, {scene.mesh, options, {}, 0}}};
  for (Way& way : ways) way.mesh.set_rules(scene.mesh.rules());  // nothing shared between them
  ways[0].options.hold_candidates = true, ways[1].options.hold_candidates = false;
  const double edge = usual_edge(scene);
  Pause pause{std::vector<char>(std::size_t(settings.pause_bytes))};
  for (int k = 0; k < settings.calls; ++k) {
    const Positions p = positions_of(scene, settings, edge, k);
    const auto ask = [&](const onset::Mesh& mesh, const onset::Options& o) { return call(mesh, p, o); };
    Way &first = ways[std::size_t(k % 2)], &second = ways[std::size_t(1 - k % 2)];
    const bool counts = k >= kFirstCalls;
    const auto a = first.time(ask, pause, counts), b = second.time(ask, pause, counts);
    if (!same(a, b)) throw std::runtime_error(format("call %d gave another answer where pairs were held", k));
  }
  return {spread(ways[0].cpu), spread(ways[1].cpu), ways[0].served};
}

Json json_of(const LoopCost::OfCall& c) {
  return {{"held", spread_json(c.held)}, {"fresh", spread_json(c.fresh)}, {"served", c.served}};
}

std::string row(const char* name, const LoopCost::OfCall& c, int calls) {
  return format("  %-12s %10.3f %10.3f %8.2f   %d of %d\n", name, 1e3 * c.held.median, 1e3 * c.fresh.median,
                c.fresh.median / c.held.median, c.served, calls);
}

}  // namespace

LoopCost bench_loop(const Scene& scene, const onset::Options& options, const LoopSettings& settings) {
  LoopCost cost;
  cost.later_calls = std::max(0, settings.calls - kFirstCalls);
  cost.active_set = bench_calls(
      scene, options, settings,
      [](const onset::Mesh& mesh, const Positions& p, const onset::Options& o) {
        return onset::construct_active_set(mesh, p.x_t0, p.x_t1, o);
      },
      [](const onset::ActiveSet& a, const onset::ActiveSet& b) { return hash_of(a) == hash_of(b); });
  cost.step = bench_calls(
      scene, options, settings,
      [](const onset::Mesh& mesh, const Positions& p, const onset::Options& o) {
        return onset::compute_collision_free_stepsize(mesh, p.x_t0, p.x_t1, o);
      },
      [](const onset::StepResult& a, const onset::StepResult& b) {
        return a.step == b.step && a.toi == b.toi;
      });
  return cost;
}

Json loop_json(const LoopCost& cost, const LoopSettings& settings) {
  return {{"calls", settings.calls},         {"motion", settings.motion},
          {"change", settings.change},       {"pause_bytes", settings.pause_bytes},
          {"later_calls", cost.later_calls}, {"active_set", json_of(cost.active_set)},
          {"step", json_of(cost.step)}};
}

std::string describe(const LoopCost& cost, const LoopSettings& settings) {
  return format("loop of %d calls, %g of the motion, changes of up to %g edges, %s between calls\n",
                settings.calls, settings.motion, settings.change,
                settings.pause_bytes > 0
                    ? format("%lld MiB touched", static_cast<long long>(settings.pause_bytes >> 20)).c_str()
                    : "nothing") +
         "  CPU ms, median     held      fresh    ratio   held pairs used\n" +
         row("active set", cost.active_set, cost.later_calls) +
         row("step size", cost.step, cost.later_calls) + "\n";
}

}  // namespace app
