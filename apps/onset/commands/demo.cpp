// onset demo: what a newcomer should see, on a scene of its own.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <onset/onset.hpp>

#include "files/ply_output.hpp"
#include "onset/command_line/arguments.hpp"
#include "onset/command_line/commands.hpp"
#include "onset/command_line/values.hpp"
#include "onset/commands/demo_scene.hpp"
#include "onset/results/progress.hpp"
#include "onset/results/report.hpp"

namespace app {
namespace {

constexpr double kCaution =
    0.9;  // of the free step: a step to its very end would leave a gap of no more than the tolerance

struct DemoResult {
  onset::StepResult step;
  onset::ActiveSet whole, taken;  // over the whole motion, over the part that was taken
  double taken_step = 0;
  Points x;  // where that part ends
};

DemoResult compute(const DemoScene& scene, const onset::Mesh& mesh, const onset::Options& options) {
  const Progress progress("demo");
  DemoResult r;
  r.step = onset::compute_collision_free_stepsize(mesh, scene.x_t0, scene.x_t1, options);
  r.whole = onset::construct_active_set(mesh, scene.x_t0, scene.x_t1, options);
  r.taken_step = r.step.outcome == onset::Outcome::free ? 1 : kCaution * r.step.step;
  r.x = scene.x_t0 + r.taken_step * (scene.x_t1 - scene.x_t0);
  r.taken = onset::construct_active_set(mesh, scene.x_t0, r.x, options);
  return r;
}

std::vector<Colour> colours(const DemoResult& r) {
  double earliest = 1;
  for (const onset::Contact& contact : r.whole) earliest = std::min(earliest, contact.toi);
  std::vector<Colour> result;
  for (const double toi : toi_of_vertices(r.whole, std::size_t(r.x.rows())))
    result.push_back(colour_of(toi, earliest));
  return result;
}

std::string summary(const DemoScene& scene, const onset::Mesh& mesh, const DemoResult& r,
                    const std::string& file) {
  std::string text =
      format("A cloth of %td triangles, folded in two, drops on a sphere of %td triangles.\n\n",
             scene.cloth_faces, scene.sphere_faces);
  text += describe_sizes(mesh.num_vertices(), mesh.num_edges(), mesh.num_faces());
  text += "\nHow far can it go? (compute_collision_free_stepsize)\n" + describe_step(r.step) +
          describe_stats(r.step.stats);
  text += format(
      "\nWhat would touch in the whole step? (construct_active_set)\ncontacts    %s\nseconds     %.3g\n",
      describe(r.whole.stats.contacts).c_str(), r.whole.stats.seconds_total);
  text += format("\nAnd in the %.4f of the step that is taken, %.0f %% of what is free?\ncontacts    %s\n",
                 r.taken_step, 100 * kCaution, describe(r.taken.stats.contacts).c_str());
  return text + "\nwritten     " + file +
         "\n            where the cloth is then, coloured by time of impact: red first, "
         "blue last, grey never\n";
}

Json to_json(const DemoResult& r, const std::string& file) {
  return {{"step", step_json(r.step)},
          {"active_set", active_set_json(r.whole)},
          {"taken", {{"step", r.taken_step}, {"active_set", active_set_json(r.taken)}}},
          {"file", file}};
}

struct Inputs : Arguments {
  std::string output = "demo.ply";
};

void run_demo(const Inputs& inputs) {
  const onset::Options options = to_options(inputs);
  Outputs outputs(inputs, {});
  outputs.announce("--output", inputs.output);
  const DemoScene scene = make_demo_scene();
  const onset::Mesh mesh(scene.x_t0, scene.faces);
  const DemoResult result = compute(scene, mesh, options);
  write_coloured_ply(outputs.file(inputs.output), result.x, scene.faces, colours(result));
  const std::string file = std::filesystem::absolute(inputs.output).string();
  if (outputs.csv()) write_active_set_csv(*outputs.csv(), result.whole);
  outputs.finish(to_json(result, file), summary(scene, mesh, result, file));
}

}  // namespace

void add_demo(CLI::App& app, Run& run) {
  const auto inputs = std::make_shared<Inputs>();
  CLI::App* command =
      app.add_subcommand("demo", "A folded cloth drops on a sphere: no files needed, writes demo.ply");
  command->add_option("--output", inputs->output, "Where the coloured mesh goes")
      ->check(path_fault)
      ->type_name("FILE")
      ->capture_default_str();
  add_common_options(*command, *inputs, "the contacts of the whole step, as active-set writes them");
  command->callback([&run, inputs] { run = [inputs] { run_demo(*inputs); }; });
}

}  // namespace app
