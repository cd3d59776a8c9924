// onset bench: what the calls cost, on a scene of files or on generated ones.
#include <CLI/CLI.hpp>
#include <functional>
#include <memory>

#include "files/error.hpp"
#include "onset/bench/bench_report.hpp"
#include "onset/bench/generated.hpp"
#include "onset/bench/kernel_bench.hpp"
#include "onset/bench/loop_bench.hpp"
#include "onset/command_line/arguments.hpp"
#include "onset/command_line/bodies.hpp"
#include "onset/command_line/commands.hpp"
#include "onset/command_line/values.hpp"
#include "onset/results/progress.hpp"

namespace app {
namespace {

struct Inputs : Arguments {
  std::string a, b;
  std::vector<std::int64_t> cloths, plates;
  int repeats = 5, refine = 0;
  bool weld = false, small = false;
  std::vector<std::string> planes;
  LoopSettings loop{0, 1, 0.005, 0};
  int pause_mebibytes = 0, kernel_rounds = 0;
};

Faces faces_of(const onset::Mesh& mesh) {
  Faces faces(mesh.num_faces(), 3);
  for (Eigen::Index f = 0; f < faces.rows(); ++f)
    for (int c = 0; c < 3; ++c) faces(f, c) = mesh.face(f)[std::size_t(c)];
  return faces;
}

Scene to_scene(Frames frames) {
  onset::Mesh mesh(frames.x_t0.rows(), frames.faces);
  return {std::move(mesh), std::move(frames.x_t0), std::move(frames.x_t1), {}, "", false};
}

Scene read_refined(const Inputs& inputs, int times) {
  Scene scene = read_scene(inputs.a, inputs.b);
  if (times == 0) {
    onset::CollisionRules rules = scene.mesh.rules();
    rules.weld = inputs.weld;
    scene.mesh.set_rules(rules);
    return scene;
  }
  Frames frames{std::move(scene.x_t0), std::move(scene.x_t1), faces_of(scene.mesh)};
  const bool is_surface = onset::edges(frames.faces).rows() == scene.mesh.num_edges();
  if (!is_surface) throw UsageError("bench: --refine divides faces, " + inputs.a + " has wires or points");
  return to_scene(refined(std::move(frames), times));
}

NamedCost bench(const std::string& name, const Scene& scene, const onset::Options& options,
                const Inputs& inputs) {
  NamedCost cost{name,
                 scene.mesh.num_vertices(),
                 scene.mesh.num_edges(),
                 scene.mesh.num_faces(),
                 bench_scene(scene, options, inputs.repeats),
                 {},
                 {}};
  if (inputs.loop.calls > 0) cost.loop = bench_loop(scene, options, inputs.loop);
  if (inputs.kernel_rounds > 0) cost.kernels = bench_kernels(scene, options, inputs.kernel_rounds);
  return cost;
}

// The scenes one after another, each as it is and then refined; only one is in memory at a time.
std::vector<NamedCost> bench_all(const Inputs& inputs, const onset::Options& options, Outputs& outputs) {
  std::vector<NamedCost> costs;
  const std::vector<onset::Plane> planes = to_planes(inputs.planes);
  const auto each_refinement = [&](const std::string& name, const std::function<Scene(int)>& make) {
    for (int times = 0; times <= inputs.refine; ++times) {
      const Progress progress("bench " + name);
      Scene scene = make(times);
      if (!planes.empty()) {
        onset::CollisionRules rules = scene.mesh.rules();
        rules.planes = planes;
        scene.mesh.set_rules(rules);
      }
      costs.push_back(
          bench(times ? format("%s, refined %d times", name.c_str(), times) : name, scene, options, inputs));
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
  if (inputs.small)
    for (const std::int64_t n : {200, 2000})
      each_refinement(format("at rest, %lld triangles", static_cast<long long>(n)),
                      [&](int times) { return to_scene(refined(still_sheets(n), times)); });
  for (const std::int64_t n : inputs.plates)
    each_refinement(format("resting plates, %lld triangles", static_cast<long long>(n)),
                    [&](int times) { return to_scene(refined(resting_plates(n), times)); });
  return costs;
}

void run_bench(const Inputs& inputs) {
  const onset::Options options = to_options(inputs);
  if (inputs.a.empty() == (inputs.cloths.empty() && inputs.plates.empty() && !inputs.small))
    throw UsageError("bench: either two frames A and B or --cloth, --resting or --small");
  if (!inputs.a.empty() && inputs.b.empty()) throw UsageError("bench: B is missing");
  if (inputs.weld && (inputs.a.empty() || inputs.refine > 0))
    throw UsageError("bench: --weld is for the frames A and B as they are, not refined");
  Outputs outputs(inputs, {inputs.a, inputs.b});
  const std::vector<NamedCost> costs = bench_all(inputs, options, outputs);
  if (outputs.csv()) write_csv(*outputs.csv(), costs);
  Json json = {{"repeats", inputs.repeats}, {"scenes", Json::array()}};
  std::string text;
  for (const NamedCost& cost : costs) {
    json["scenes"].push_back(cost_json(cost));
    text += describe(cost, inputs.repeats);
    if (!cost.kernels.empty()) {
      json["scenes"].back()["kernels"] = kernels_json(cost.kernels);
      text += describe(cost.kernels);
    }
    if (!cost.loop) continue;
    json["scenes"].back()["loop"] = loop_json(*cost.loop, inputs.loop);
    text += describe(*cost.loop, inputs.loop);
  }
  outputs.finish(json, costs.size() > 1 ? text + describe_curve(costs) : text);
}

}  // namespace

void add_bench(CLI::App& app, Run& run) {
  const auto inputs = std::make_shared<Inputs>();
  CLI::App* command =
      app.add_subcommand("bench", "Times, pairs at each stage and memory of the library's calls on a scene");
  command->add_option("A", inputs->a, kMeshHelp)->check(path_fault);
  command->add_option("B", inputs->b, kEndHelp)->check(path_fault);
  command
      ->add_option("--cloth", inputs->cloths,
                   "Instead of A and B, a generated scene of about COUNT triangles; several for a curve")
      ->type_name("COUNT,...")
      ->delimiter(',')
      ->check(whole_numbers(4, 1'000'000'000));
  command
      ->add_option("--resting", inputs->plates,
                   "The same of two flat sheets that lie on one another up to rounding")
      ->type_name("COUNT,...")
      ->delimiter(',')
      ->check(whole_numbers(4, 1'000'000'000));
  command->add_flag("--small", inputs->small, "The same of meshes of 200 and 2,000 triangles at rest");
  add_whole(*command, "--refine", inputs->refine, "TIMES",
            "Divide each triangle into four, up to TIMES over, and measure each time", 0, 8);
  add_whole(*command, "--repeats", inputs->repeats, "COUNT",
            "Runs of each call, after one to warm up; 0: times that one, for scenes that take long [5]", 0,
            1000);
  add_whole(*command, "--loop", inputs->loop.calls, "COUNT",
            "Also so many calls as a Newton solver makes them, on positions that change a little each time, "
            "with and "
            "without pairs held from call to call; 0: none [0]",
            0, 100000);
  command->add_option("--motion", inputs->loop.motion, "Of --loop: the share of the motion from A to B [1]")
      ->type_name("SHARE")
      ->check(CLI::Range(0.0, 1.0));
  command
      ->add_option("--change", inputs->loop.change,
                   "Of --loop: how far coordinates change from call to call, in usual edges [0.005]")
      ->type_name("EDGES")
      ->check(CLI::Range(0.0, 1.0));
  add_whole(*command, "--pause", inputs->pause_mebibytes, "MIB",
            "Of --loop: memory that is touched between calls, so that no cache is warm [0]", 0, 4096);
  add_whole(*command, "--kernels", inputs->kernel_rounds, "COUNT",
            "Also so many calls with each instruction set that this machine has, in turns; 0: none [0]", 0,
            100000);
  add_weld(*command, inputs->weld);
  add_planes(*command, inputs->planes);
  add_common_options(*command, *inputs, "one row a scene, its size and the cost of the active set");
  command->callback([&run, inputs] {
    inputs->loop.pause_bytes = std::int64_t(inputs->pause_mebibytes) << 20;
    run = [inputs] { run_bench(*inputs); };
  });
}

}  // namespace app
