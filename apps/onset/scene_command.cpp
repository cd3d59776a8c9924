#include "scene_command.hpp"

#include <memory>

#include "arguments.hpp"
#include "bodies.hpp"
#include "report.hpp"

namespace app {

CLI::App* add_scene_command(CLI::App& app, Run& run, const std::string& name, const std::string& help,
                            const std::string& csv_columns, SceneWork work,
                            std::shared_ptr<Arguments>* arguments) {
  struct Inputs : Arguments, BodyArguments {
    std::string a, b;
  };
  const auto inputs = std::make_shared<Inputs>();
  CLI::App* command = app.add_subcommand(name, help);
  command->add_option("A", inputs->a, kMeshHelp)
      ->required();
  command->add_option("B", inputs->b, kEndHelp)
      ->required();
  add_common_options(*command, *inputs, csv_columns);
  add_body_options(*command, *inputs);
  command->callback([&run, inputs, work = std::move(work)] {
    run = [inputs, work] {
      const onset::Options options = to_options(*inputs);
      Scene scene = read_scene(inputs->a, inputs->b);
      set_bodies(*inputs, scene.mesh);
      Outputs outputs(*inputs);
      for (const std::string& note : scene.notes) outputs.note(note);
      work(scene, options, outputs);
    };
  });
  if (arguments) *arguments = inputs;
  return command;
}

std::string describe_sizes(const onset::Mesh& mesh) {
  const std::ptrdiff_t points = mesh.num_points();
  std::string text = describe_sizes(mesh.num_vertices(), mesh.num_edges() - points, mesh.num_faces());
  if (points > 0) text.insert(text.size() - 1, format(", %td points (edges of length 0 behind all others)", points));
  return text;
}

}  // namespace app
