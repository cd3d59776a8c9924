// onset filters: which pairs a scene can have, and what left the others out.
#include <memory>
#include <set>
#include <utility>

#include "files/scene/scene.hpp"
#include "onset/command_line/bodies.hpp"
#include "onset/command_line/commands.hpp"
#include "onset/command_line/values.hpp"
#include "onset/commands/scene_command.hpp"
#include "onset/results/report.hpp"

namespace app {
namespace {

struct Inputs : Arguments, BodyArguments {
  std::string a, b;
};

// Bodies none of whose vertices moves from A to B.
std::vector<int> at_rest(const Scene& scene) {
  std::set<int> moving;
  for (Eigen::Index v = 0; v < scene.x_t0.rows(); ++v)
    if (scene.x_t0.row(v) != scene.x_t1.row(v)) moving.insert(scene.mesh.body(v));
  std::vector<int> rest;
  for (int b = 0; b < scene.mesh.num_bodies(); ++b)
    if (moving.count(b) == 0) rest.push_back(b);
  return rest;
}

std::string words(const char* name, const onset::PairFilterCounts& plan, const char* needs) {
  const auto number = [](std::int64_t n) { return static_cast<long long>(n); };
  std::string text = format("%-11s ", name);
  if (plan.pairs == 0) return text + "dropped: the mesh has no " + needs + "\n";
  text += plan.may_meet() > 0 ? format("%lld pairs may meet", number(plan.may_meet()))
                              : std::string("dropped: no pair may meet");
  text += format(" of %lld; left out:", number(plan.pairs));
  const std::pair<const char*, std::int64_t> reasons[] = {
      {"masked", plan.masked},     {"static", plan.both_static}, {"same body", plan.same_body},
      {"adjacent", plan.adjacent}, {"excluded", plan.excluded},  {"within rings", plan.within_rings}};
  const char* separator = " ";
  for (const auto& [reason, count] : reasons)
    if (count > 0) text += format("%s%lld %s", separator, number(count), reason), separator = ", ";
  return text + (separator[0] == ' ' ? " none\n" : "\n");
}

std::string words(const char* name, const onset::PrimitiveFilterCounts& plan) {
  return format("%-11s %lld moving, %lld static, %lld dropped\n", name, static_cast<long long>(plan.moving),
                static_cast<long long>(plan.statics), static_cast<long long>(plan.dropped));
}

void report(const Scene& scene, const Inputs& inputs) {
  const onset::FilterCounts& plan = scene.mesh.filter_counts();
  std::string text =
      describe_sizes(scene.mesh) + format("bodies      %d\n", scene.mesh.num_bodies()) +
      (scene.mesh.dimension() == 2 ? words("vertex-edge", plan.vertex_edge, "vertex and edge")
                                   : words("vertex-face", plan.vertex_face, "vertex and face") +
                                         words("edge-edge", plan.edge_edge, "two edges")) +
      words("vertices", plan.vertices) + words("edges", plan.edges) + words("faces", plan.faces);
  Json json = {{"bodies", scene.mesh.num_bodies()}, {"plan", to_json(plan)}};
  if (!inputs.b.empty()) {
    const std::vector<int> rest = at_rest(scene);
    json["at_rest"] = rest;
    text += format("at rest     %zu bodies", rest.size());
    for (std::size_t i = 0; i < rest.size() && i < 10; ++i)
      text += format("%s%d", i == 0 ? ": " : " ", rest[i]);
    text += rest.size() > 10 ? " ...\n" : "\n";
  }
  Outputs outputs(inputs, {inputs.a, inputs.b, inputs.rest});
  for (const std::string& note : scene.notes) outputs.note(note);
  outputs.finish(json, text);
}

}  // namespace

void add_plan(CLI::App& app, Run& run) {
  const auto inputs = std::make_shared<Inputs>();
  CLI::App* command =
      app.add_subcommand("filters", "Which pairs a scene can have at all, and why it has no others")
          ->alias("plan");
  command->add_option("A", inputs->a, "Mesh: .ply, .obj, .off or .stl")->required()->check(path_fault);
  command->add_option("B", inputs->b, "The same mesh later: tells which bodies are at rest")
      ->check(path_fault);
  add_body_options(*command, *inputs);
  add_json(*command, *inputs);
  command->callback([&run, inputs] {
    run = [inputs] {
      Scene scene = read_scene(inputs->a, inputs->b.empty() ? inputs->a : inputs->b);
      set_bodies(*inputs, scene);
      report(scene, *inputs);
    };
  });
}

}  // namespace app
