// onset step: how far the motion can go.
#include "onset/commands/scene_command.hpp"
#include "onset/exports/scene_files.hpp"
#include "onset/results/progress.hpp"
#include "onset/results/report.hpp"

namespace app {
namespace {

onset::StepResult compute(const Scene& scene, const onset::Options& options) {
  const Progress progress("step");
  return onset::compute_collision_free_stepsize(scene.mesh, scene.start(), scene.end(), options);
}

}  // namespace

void add_step(CLI::App& app, Run& run) {
  const auto files = std::make_shared<SceneFiles>();
  CLI::App* command = add_scene_command(
      app, run, "step", "The largest step from A towards B that is certainly free of contact", kStepColumns,
      [files](const Scene& scene, const onset::Options& options, Outputs& outputs) {
        announce(*files, scene, outputs);
        const onset::StepResult result = compute(scene, options);
        const bool in_contact = result.outcome == onset::Outcome::initial_contact;
        if (result.vertex < 0) note_start(scene, options, in_contact, outputs);
        if (outputs.csv()) write_step_csv(*outputs.csv(), result);
        write_files(*files, scene, options, result, outputs);
        outputs.finish(step_json(result),
                       describe_sizes(scene.mesh) + describe_step(result) + describe_stats(result.stats));
      });
  add_scene_files(*command, *files);
}

}  // namespace app
