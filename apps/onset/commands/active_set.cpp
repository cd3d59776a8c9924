// onset active-set: what touches during the step.
#include <algorithm>

#include "onset/commands/scene_command.hpp"
#include "onset/exports/scene_files.hpp"
#include "onset/results/progress.hpp"
#include "onset/results/report.hpp"

namespace app {
namespace {

onset::ActiveSet compute(const Scene& scene, const onset::Options& options) {
  const Progress progress("active set");
  return onset::construct_active_set(scene.mesh, scene.start(), scene.end(), options);
}

bool starts_in_contact(const onset::ActiveSet& set) {
  return std::any_of(set.begin(), set.end(), [](const onset::Contact& contact) {
    return contact.outcome == onset::PairOutcome::initial_contact;
  });
}

}  // namespace

void add_active_set(CLI::App& app, Run& run) {
  const auto files = std::make_shared<SceneFiles>();
  std::shared_ptr<Arguments> arguments;
  CLI::App* command = add_scene_command(
      app, run, "active-set", "Every pair that comes into contact between A and B, with its time of impact",
      std::string(kActiveSetColumns) + " " + kActiveSetHelp,
      [files](const Scene& scene, const onset::Options& options, Outputs& outputs) {
        announce(*files, scene, outputs);
        const onset::ActiveSet set = compute(scene, options);
        if (set.vertex < 0) note_start(scene, options, starts_in_contact(set), outputs);
        if (outputs.csv()) write_active_set_csv(*outputs.csv(), set);
        write_files(*files, scene, options, set, outputs);
        outputs.finish(active_set_json(set), describe_sizes(scene.mesh) + describe_active_set(set));
      },
      &arguments);
  add_window(*command, *arguments);
  add_scene_files(*command, *files);
}

}  // namespace app
