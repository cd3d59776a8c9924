// onset check: whether a step can start here, and what is in the way.
#include <memory>

#include "files/scene/places.hpp"
#include "onset/command_line/bodies.hpp"
#include "onset/command_line/commands.hpp"
#include "onset/command_line/values.hpp"
#include "onset/commands/scene_command.hpp"
#include "onset/results/progress.hpp"
#include "onset/results/report.hpp"
#include "onset/results/start_report.hpp"

namespace app {
namespace {

struct Inputs : Arguments, BodyArguments {
  std::string a, b, geometry;
};

// With the end of a step, --weld makes one only of what is together there too, as it does in a step.
void join_copies(const Inputs& inputs, Scene& scene) {
  if (!inputs.weld || inputs.b.empty()) return;
  if (copies_together(scene.x_t0, scene.x_t1) == copies_together(scene.x_t0, scene.x_t0)) return;
  onset::CollisionRules rules = scene.mesh.rules();
  rules.weld = false;
  rules.excluded_vertices = at_the_end(onset::duplicate_vertices(scene.x_t0), scene.x_t1).together;
  scene.mesh.set_rules(rules);
}

onset::StartReport look(const Scene& scene, const onset::Options& options) {
  const Progress progress("check");
  return onset::check(scene.mesh, scene.start(), options);
}

void run_check(const Inputs& inputs) {
  const onset::Options options = to_options(inputs);
  Scene scene = read_scene(inputs.a, inputs.b.empty() ? inputs.a : inputs.b);
  set_bodies(inputs, scene);
  join_copies(inputs, scene);
  Outputs outputs(inputs, {inputs.a, inputs.b, inputs.rest});
  if (!inputs.geometry.empty()) outputs.announce("--export", inputs.geometry);
  for (const std::string& note : scene.notes) outputs.note(note);
  const onset::StartReport report = look(scene, options);
  StartFindings findings{scene, report, std::nullopt};
  if (!inputs.b.empty()) findings.copies = at_the_end(report.copied_vertices, scene.x_t1);
  if (outputs.csv()) write_csv(*outputs.csv(), findings);
  if (!inputs.geometry.empty()) write_start_ply(outputs.file(inputs.geometry), scene, report);
  outputs.finish(to_json(findings), describe_sizes(scene.mesh) + describe(findings));
  if (!report.clean()) throw NotClean();
}

}  // namespace

void add_check(CLI::App& app, Run& run) {
  const auto inputs = std::make_shared<Inputs>();
  CLI::App* command = app.add_subcommand(
      "check",
      "Whether a step can start at FILE: intersections, touching pairs, copied vertices and more, exactly");
  command->add_option("FILE", inputs->a, kMeshHelp)->required()->check(path_fault);
  command->add_option("END", inputs->b, "The end of a step: tells which copied vertices stay together")
      ->check(path_fault);
  add_common_options(*command, *inputs, kStartColumns);
  add_body_options(*command, *inputs);
  command
      ->add_option(
          "--export", inputs->geometry,
          "Write PLY of what meets: edges that intersect faces red, the faces yellow, what only touches blue")
      ->check(path_fault)
      ->type_name("FILE");
  command->footer(
      "Exit status: 0 nothing found; 3 something was, or a budget ended the search; 1 bad input; 2 wrong "
      "usage.\n"
      "Of the options those of accuracy do not matter here, but --min-separation and --norm do.");
  command->callback([&run, inputs] { run = [inputs] { run_check(*inputs); }; });
}

}  // namespace app
