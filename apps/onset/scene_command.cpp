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
  command->add_option("A", inputs->a, "Mesh at the start of the step: .ply, .obj or .off, triangles")
      ->required();
  command->add_option("B", inputs->b, "The same mesh at its end: the same faces in the same order")
      ->required();
  add_common_options(*command, *inputs, csv_columns);
  add_body_options(*command, *inputs);
  command->callback([&run, inputs, work = std::move(work)] {
    run = [inputs, work] {
      const onset::Options options = to_options(*inputs);
      Scene scene = read_scene(inputs->a, inputs->b);
      set_bodies(*inputs, scene.mesh);
      Outputs outputs(*inputs);
      work(scene, options, outputs);
    };
  });
  if (arguments) *arguments = inputs;
  return command;
}

std::string describe_sizes(const onset::Mesh& mesh) {
  return describe_sizes(mesh.num_vertices(), mesh.num_edges(), mesh.num_faces());
}

}  // namespace app
