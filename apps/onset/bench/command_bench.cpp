// onset bench: what the calls cost, on a scene of files or on generated ones.
#include <CLI/CLI.hpp>
#include <functional>
#include <memory>

#include "files/error.hpp"
#include "onset/bench/generated.hpp"
#include "onset/bench/scene_bench.hpp"
#include "onset/command_line/arguments.hpp"
#include "onset/command_line/bodies.hpp"
#include "onset/command_line/commands.hpp"
#include "onset/results/progress.hpp"
#include "onset/results/report.hpp"

namespace app {
namespace {

struct Inputs : Arguments {
  std::string a, b;
  std::vector<std::int64_t> cloths;
  int repeats = 5, refine = 0;
  bool weld = false;
};

struct NamedCost {
  std::string name;
  std::ptrdiff_t vertices, edges, faces;
  SceneCost cost;

  std::ptrdiff_t primitives() const { return vertices + edges + faces; }
};

// Whether all of its edges are those of faces.
bool is_surface(const onset::Mesh& mesh) {
  Faces faces(mesh.num_faces(), 3);
  for (Eigen::Index f = 0; f < faces.rows(); ++f)
    for (int c = 0; c < 3; ++c) faces(f, c) = mesh.face(f)[std::size_t(c)];
  return onset::edges(faces).rows() == mesh.num_edges();
}

Scene to_scene(Frames frames) {
  onset::Mesh mesh(frames.x_t0.rows(), frames.faces);
  return {std::move(mesh), std::move(frames.x_t0), std::move(frames.x_t1), {}, "", false};
}

Scene read_refined(const Inputs& inputs, int times) {
  Scene scene = read_scene(inputs.a, inputs.b);
  if (times == 0) {
    if (inputs.weld) scene.mesh.set_weld(true);
    return scene;
  }
  if (!is_surface(scene.mesh)) throw UsageError("bench: --refine divides faces, " + inputs.a + " has wires or points");
  Frames frames{std::move(scene.x_t0), std::move(scene.x_t1), Faces(scene.mesh.num_faces(), 3)};
  for (Eigen::Index f = 0; f < frames.faces.rows(); ++f)
    for (int c = 0; c < 3; ++c) frames.faces(f, c) = scene.mesh.face(f)[std::size_t(c)];
  return to_scene(refined(std::move(frames), times));
}

Json call_json(const CallCost& c) {
  Json json = {{"wall", spread_json(c.wall)},
               {"cpu", spread_json(c.cpu)},
               {"broad", spread_json(c.broad)},
               {"narrow", spread_json(c.narrow)}};
  json["peak_bytes"] = c.peak_bytes ? Json(*c.peak_bytes) : Json();
  return json;
}

std::string hex(std::uint64_t hash) { return format("%016llx", static_cast<unsigned long long>(hash)); }

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

std::string describe(const NamedCost& n, int repeats) {
  const SceneCost& c = n.cost;
  const onset::Stats& s = c.stats;
  return n.name + "\n" + describe_sizes(n.vertices, n.edges, n.faces) +
         format("threads     %d, kernel %s, broad phase %s, tolerance %.3g, %d repeats\n", s.threads,
                s.kernel, s.broad_phase, s.tolerance, repeats) +
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

// The curve: what must not grow with size.
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

NamedCost bench(const std::string& name, const Scene& scene, const onset::Options& options, int repeats) {
  return {name, scene.mesh.num_vertices(), scene.mesh.num_edges(), scene.mesh.num_faces(),
          bench_scene(scene, options, repeats)};
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

// The scenes one after another, each as it is and then refined; only one is in memory at a time.
std::vector<NamedCost> bench_all(const Inputs& inputs, const onset::Options& options, Outputs& outputs) {
  std::vector<NamedCost> costs;
  const auto each_refinement = [&](const std::string& name, const std::function<Scene(int)>& make) {
    for (int times = 0; times <= inputs.refine; ++times) {
      const Progress progress("bench " + name);
      costs.push_back(bench(times ? format("%s, refined %d times", name.c_str(), times) : name, make(times),
                            options, inputs.repeats));
    }
  };
  if (!inputs.a.empty())
    each_refinement(inputs.a, [&](int times) {
      Scene scene = read_refined(inputs, times);
      for (const std::string& note : scene.notes) outputs.note(note);
      return scene;
    });
  for (const std::int64_t n : inputs.cloths)
    each_refinement(format("layered cloth, %lld triangles", static_cast<long long>(n)),
                    [&](int times) { return to_scene(refined(layered_cloth(n), times)); });
  return costs;
}

void run_bench(const Inputs& inputs) {
  const onset::Options options = to_options(inputs);
  if (inputs.a.empty() == inputs.cloths.empty())
    throw UsageError("bench: either two frames A and B or --cloth");
  if (!inputs.a.empty() && inputs.b.empty()) throw UsageError("bench: B is missing");
  if (inputs.weld && (inputs.a.empty() || inputs.refine > 0))
    throw UsageError("bench: --weld is for the frames A and B as they are, not refined");
  Outputs outputs(inputs);
  const std::vector<NamedCost> costs = bench_all(inputs, options, outputs);
  if (outputs.csv()) write_csv(*outputs.csv(), costs);
  Json json = {{"repeats", inputs.repeats}, {"scenes", Json::array()}};
  std::string text;
  for (const NamedCost& cost : costs) {
    json["scenes"].push_back(cost_json(cost));
    text += describe(cost, inputs.repeats);
  }
  outputs.finish(json, costs.size() > 1 ? text + describe_curve(costs) : text);
}

}  // namespace

void add_bench(CLI::App& app, Run& run) {
  const auto inputs = std::make_shared<Inputs>();
  CLI::App* command =
      app.add_subcommand("bench", "Times, pairs at each stage and memory of the library's calls on a scene");
  command->add_option("A", inputs->a, kMeshHelp);
  command->add_option("B", inputs->b, kEndHelp);
  command
      ->add_option("--cloth", inputs->cloths,
                   "Instead of A and B, a generated scene of about COUNT triangles; several for a curve")
      ->type_name("COUNT,...")
      ->delimiter(',')
      ->check(CLI::Range(std::int64_t(4), std::int64_t(1'000'000'000)));
  command
      ->add_option("--refine", inputs->refine,
                   "Divide each triangle into four, up to TIMES over, and measure each time")
      ->type_name("TIMES")
      ->check(CLI::Range(0, 8));
  command
      ->add_option("--repeats", inputs->repeats,
                   "Runs of each call, after one to warm up; 0: times that one, for scenes that take long")
      ->type_name("COUNT")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  add_weld(*command, inputs->weld);
  add_common_options(*command, *inputs, "one row a scene, its size and the cost of the active set");
  command->callback([&run, inputs] { run = [inputs] { run_bench(*inputs); }; });
}

}  // namespace app
