#include "onset/bench/bench_report.hpp"

#include "onset/results/report.hpp"

namespace app {
namespace {

Json call_json(const CallCost& c) {
  Json json = {{"wall", spread_json(c.wall)},
               {"cpu", spread_json(c.cpu)},
               {"broad", spread_json(c.broad)},
               {"narrow", spread_json(c.narrow)}};
  json["peak_bytes"] = c.peak_bytes ? Json(*c.peak_bytes) : Json();
  return json;
}

std::string hex(std::uint64_t hash) { return format("%016llx", static_cast<unsigned long long>(hash)); }

std::string row(const char* name, const Spread& s) {
  return format("  %-22s %10.3f   [%.3f, %.3f]\n", name, 1e3 * s.median, 1e3 * s.least, 1e3 * s.most);
}

std::string memory(const CallCost& c, std::ptrdiff_t primitives) {
  if (!c.peak_bytes) return "  peak memory            unknown on this system\n";
  return format("  %-22s %10.1f   MiB, %.0f bytes a primitive\n", "peak memory",
                double(*c.peak_bytes) / (1 << 20), double(*c.peak_bytes) / double(primitives));
}

std::string describe(const char* name, const CallCost& c, std::ptrdiff_t primitives) {
  return std::string(name) + ", ms: median [least, most]\n" + row("wall", c.wall) + row("cpu", c.cpu) +
         row("boxes and tree", c.broad) + (c.narrow.most > 0 ? row("pairs and certificates", c.narrow) : "") +
         memory(c, primitives);
}

std::string stage(const char* name, const onset::PairCounts& c) {
  return format("  %-22s %12lld %12lld\n", name, static_cast<long long>(c.vertex_face),
                static_cast<long long>(c.edge_edge));
}

}  // namespace

Json cost_json(const NamedCost& n) {
  const SceneCost& c = n.cost;
  return {{"scene", n.name},
          {"vertices", n.vertices},
          {"edges", n.edges},
          {"faces", n.faces},
          {"active_set", call_json(c.active_set)},
          {"step", call_json(c.step)},
          {"pairs", call_json(c.pairs)},
          {"ns_a_candidate", c.narrow_ns_a_candidate()},
          {"checks_a_hit", c.checks_a_hit()},
          {"hash", hex(c.hash)},
          {"step_size", c.step_result.step},
          {"tolerance", c.stats.tolerance},
          {"stats", to_json(c.stats)}};
}

std::string describe(const NamedCost& n, int repeats) {
  const SceneCost& c = n.cost;
  const onset::Stats& s = c.stats;
  return n.name + "\n" + describe_sizes(n.vertices, n.edges, n.faces) +
         format("threads     %d, kernel %s, broad phase %s, tolerance %.3g, %d repeats\n", s.threads,
                s.instruction_set, s.broad_phase, s.tolerance, repeats) +
         describe("active set", c.active_set, n.primitives()) +
         describe("step size", c.step, n.primitives()) +
         describe("swept pairs, counted", c.pairs, n.primitives()) +
         "pairs left              vertex-face    edge-edge\n" + stage("swept boxes overlap", s.swept) +
         stage("boxes meet in motion", s.candidates) + stage("after the culls", s.after_culls) +
         stage("to the root finder", s.inclusion) + stage("contacts", s.contacts) +
         format("narrow      %.1f ns a candidate, %.2f checks a hit, at most %lld checks a pair\n",
                c.narrow_ns_a_candidate(), c.checks_a_hit(), static_cast<long long>(s.max_checks_of_a_pair)) +
         format("result      step %.17g, active set %s\n\n", c.step_result.step, hex(c.hash).c_str());
}

std::string describe_curve(const std::vector<NamedCost>& costs) {
  std::string text = " primitives    contacts  set, ms  ns a primitive  bytes a primitive\n";
  for (const NamedCost& n : costs) {
    const CallCost& c = n.cost.active_set;
    text +=
        format("%11td %11lld %8.1f %15.1f %18s\n", n.primitives(),
               static_cast<long long>(n.cost.stats.contacts.total()), 1e3 * c.cpu.median,
               1e9 * c.cpu.median / double(n.primitives()),
               c.peak_bytes ? format("%.0f", double(*c.peak_bytes) / double(n.primitives())).c_str() : "-");
  }
  return text;
}

void write_csv(Output& csv, const std::vector<NamedCost>& costs) {
  csv.write(
      "scene,vertices,edges,faces,candidates,contacts,cpu_median,cpu_min,cpu_max,wall_median,peak_bytes\n");
  for (const NamedCost& n : costs) {
    const CallCost& c = n.cost.active_set;
    csv.write(format("\"%s\",%td,%td,%td,%lld,%lld,%.9g,%.9g,%.9g,%.9g,%lld\n", n.name.c_str(), n.vertices,
                     n.edges, n.faces, static_cast<long long>(n.cost.stats.candidates.total()),
                     static_cast<long long>(n.cost.stats.contacts.total()), c.cpu.median, c.cpu.least,
                     c.cpu.most, c.wall.median, static_cast<long long>(c.peak_bytes.value_or(-1))));
  }
}

}  // namespace app
