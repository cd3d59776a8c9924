#include "onset/commands/scene_command.hpp"

#include <algorithm>
#include <memory>

#include "files/scene/places.hpp"
#include "measure/timing.hpp"
#include "onset/command_line/arguments.hpp"
#include "onset/command_line/bodies.hpp"
#include "onset/command_line/values.hpp"
#include "onset/results/report.hpp"

namespace app {

CLI::App* add_scene_command(CLI::App& app, Run& run, const std::string& name, const std::string& help,
                            const std::string& csv_columns, SceneWork work,
                            std::shared_ptr<Arguments>* arguments) {
  struct Inputs : Arguments, BodyArguments {
    std::string a, b;
  };
  const auto inputs = std::make_shared<Inputs>();
  CLI::App* command = app.add_subcommand(name, help);
  command->add_option("A", inputs->a, kMeshHelp)->required()->check(path_fault);
  command->add_option("B", inputs->b, kEndHelp)->required()->check(path_fault);
  add_common_options(*command, *inputs, csv_columns);
  add_body_options(*command, *inputs);
  command->callback([&run, inputs, work = std::move(work)] {
    run = [inputs, work] {
      const onset::Options options = to_options(*inputs);
      Scene scene = read_scene(inputs->a, inputs->b);
      set_bodies(*inputs, scene);
      Outputs outputs(*inputs, {inputs->a, inputs->b, inputs->rest});
      for (const std::string& note : scene.notes) outputs.note(note);
      work(scene, options, outputs);
    };
  });
  if (arguments) *arguments = inputs;
  return command;
}

// What makes seams touch from the start, and the flag for it; empty where nothing does.
static std::string seam_hint(const Scene& scene) {
  constexpr std::size_t kShown = 3;
  if (scene.welded) return "";
  const std::vector<std::array<int, 2>> copies = copies_together(scene.x_t0, scene.x_t1);
  if (copies.empty()) return "";
  std::string text = "; vertices ";
  for (std::size_t i = 0; i < std::min(copies.size(), kShown); ++i)
    text += format("%s%d and %d", i ? ", " : "", copies[i][0], copies[i][1]);
  return text + (copies.size() > kShown ? format(" and %zu more pairs", copies.size() - kShown) : "") +
         " are at one place: --weld counts them as one";
}

void note_start(const Scene& scene, const onset::Options& options, bool in_contact, Outputs& outputs) {
  onset::Options all;  // of the budgets the time alone, beyond which "there may be" is the answer
  all.threads = options.threads, all.broad_phase = options.broad_phase,
  all.instruction_set = options.instruction_set, all.time_limit = options.time_limit;
  const Stopwatch watch;
  const bool may_meet = onset::has_intersections(scene.mesh, scene.start(), all);
  const bool out_of_time = watch.elapsed().wall >= options.time_limit;
  if (may_meet && out_of_time)
    outputs.note("whether the start intersects itself was not found out within the time limit");
  const bool meets = may_meet && !out_of_time;
  if (!meets && !in_contact) return;
  const bool apart = !meets && options.min_separation > 0;
  outputs.note(std::string("the start ") + (meets ? "intersects or touches itself" : "touches itself") +
               (apart ? ", or is closer than the separation" : "") + ": see 'onset check " + scene.path +
               "'" + seam_hint(scene));
}

}  // namespace app
