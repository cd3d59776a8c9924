// onset candidates: the broad phase alone.
#include "onset/commands/scene_command.hpp"
#include "onset/results/progress.hpp"
#include "onset/results/report.hpp"

namespace app {
namespace {

onset::Candidates compute(const Scene& scene, const onset::Options& options, bool list) {
  const Progress progress("candidates");
  return list ? onset::compute_candidates(scene.mesh, scene.start(), scene.end(), options)
              : onset::count_candidates(scene.mesh, scene.start(), scene.end(), options);
}

void write_rows(Output& csv, const char* kind, const std::vector<std::array<int, 2>>& pairs) {
  std::string chunk;
  for (const auto& [a, b] : pairs) {
    chunk.append(kind)
        .append(1, ',')
        .append(std::to_string(a))
        .append(1, ',')
        .append(std::to_string(b))
        .append(1, '\n');
    if (chunk.size() < 1 << 16) continue;
    csv.write(chunk);
    chunk.clear();
  }
  csv.write(chunk);
}

void write_csv(Output& csv, const onset::Candidates& candidates) {
  csv.write("kind,a,b\n");
  write_rows(csv, "vf", candidates.vertex_face);
  write_rows(csv, "ee", candidates.edge_edge);
  write_rows(csv, "ve", candidates.vertex_edge);
  write_rows(csv, "vp", candidates.vertex_plane);
}

Json candidates_json(const onset::Candidates& c) {
  Json json = {{"candidates", to_json(c.counts)},
               {"seconds", seconds_json(c.stats)},
               {"outcome", outcome_name(c.outcome)}};
  if (c.vertex >= 0) json["vertex"] = c.vertex;
  json["stats"] = to_json(c.stats);
  return json;
}

std::string summary(const onset::Candidates& c) {
  std::string text = format("outcome     %s\n", outcome_name(c.outcome));
  if (c.vertex >= 0) text += format("vertex      %d\n", c.vertex);
  text += format("candidates  %s\nseconds     %.3g", describe(c.counts).c_str(), c.stats.seconds_total);
  const std::string method = c.stats.broad_phase;  // none where the call ended before there was one
  return text + (method.empty() ? "\n" : " (" + method + ")\n");
}

}  // namespace

void add_candidates(CLI::App& app, Run& run) {
  add_scene_command(app, run, "candidates", "The pairs whose swept boxes overlap and that share no vertex",
                    "kind,a,b", [](const Scene& scene, const onset::Options& options, Outputs& outputs) {
                      const onset::Candidates candidates = compute(scene, options, outputs.csv() != nullptr);
                      if (outputs.csv()) write_csv(*outputs.csv(), candidates);
                      outputs.finish(candidates_json(candidates),
                                     describe_sizes(scene.mesh) + summary(candidates));
                    });
}

}  // namespace app
