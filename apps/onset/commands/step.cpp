// onset step: how far the motion can go.
#include "files/queries/query_kind.hpp"
#include "onset/commands/scene_command.hpp"
#include "onset/exports/scene_files.hpp"
#include "onset/results/progress.hpp"
#include "onset/results/report.hpp"

namespace app {
namespace {

constexpr char kColumns[] = "outcome,step,kind,a,b,v0,v1,v2,v3,toi,toi_hi,rounding";

void write_csv(Output& csv, const onset::StepResult& r) {
  csv.write(std::string(kColumns) + "\n");
  csv.write(format("%s,%.17g,", outcome_name(r.outcome), r.step));
  if (const std::optional<onset::Pair>& p = r.limiting)
    csv.write(format("%s,%d,%d,%d,%d,%d,%d", kind_name(p->kind), p->a, p->b, p->vertices[0], p->vertices[1],
                     p->vertices[2], p->vertices[3]));
  else
    csv.write(",,,,,,");
  csv.write(format(",%.17g,%.17g,%.17g\n", r.toi, r.toi_hi, r.rounding));
}

onset::StepResult compute(const Scene& scene, const onset::Options& options) {
  const Progress progress("step");
  return onset::compute_collision_free_stepsize(scene.mesh, scene.start(), scene.end(), options);
}

}  // namespace

void add_step(CLI::App& app, Run& run) {
  const auto files = std::make_shared<SceneFiles>();
  CLI::App* command = add_scene_command(
      app, run, "step", "The largest step from A towards B that is certainly free of contact", kColumns,
      [files](const Scene& scene, const onset::Options& options, Outputs& outputs) {
        announce(*files, scene, outputs);
        const onset::StepResult result = compute(scene, options);
        const bool in_contact = result.outcome == onset::Outcome::initial_contact;
        if (result.vertex < 0) note_start(scene, options, in_contact, outputs);
        if (outputs.csv()) write_csv(*outputs.csv(), result);
        write_files(*files, scene, options, result, outputs);
        outputs.finish(step_json(result),
                       describe_sizes(scene.mesh) + describe_step(result) + describe_stats(result.stats));
      });
  add_scene_files(*command, *files);
}

}  // namespace app
