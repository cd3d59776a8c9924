// onset_cloth: an implicit cloth simulator of a few hundred lines, as a client of the library.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "cloth/stepper.hpp"
#include "files/interrupts.hpp"
#include "files/output.hpp"

namespace {

struct Arguments {
  std::string scene = "sphere";
  int triangles = 2000;
  unsigned seed = 1;
  simulation::RunOptions run;
  cloth::Settings settings;
};

void add_options(CLI::App& app, Arguments& a) {
  app.add_option("--scene", a.scene, "sphere, twist, pile or ground")
      ->check(CLI::IsMember({"sphere", "twist", "pile", "ground"}))
      ->capture_default_str();
  app.add_option("--triangles", a.triangles, "Of the cloth, about")
      ->check(CLI::Range(40, 1000000))
      ->capture_default_str();
  app.add_option("--seed", a.seed, "Of the ripples and turns at the start")
      ->check(simulation::count())
      ->capture_default_str();
  app.add_option("--time-step", a.settings.time_step, "Seconds")
      ->check(simulation::positive())
      ->capture_default_str();
  app.add_option("--friction", a.settings.friction, "Coefficient")
      ->check(simulation::not_negative())
      ->capture_default_str();
  app.add_option("--reach", a.settings.reach, "Of the barrier, of the edges of the cloth")
      ->check(simulation::positive())
      ->capture_default_str();
  simulation::add_run_options(app, a.run);
  simulation::add_filter_options(app, a.settings.filter);
}

int run(const Arguments& a) {
  const cloth::Scene scene = cloth::make_scene(a.scene, a.triangles, a.seed);
  std::optional<simulation::State> start;
  if (!a.run.restart.empty())
    start = simulation::read_frame(a.run.restart, scene.is_free.size(), simulation::Cells(scene.faces));
  cloth::Stepper stepper(scene, a.settings, start);
  return simulation::run(stepper, a.run,
                         app::format("scene            %s, %zu triangles of cloth, %zu in all\n",
                                     a.scene.c_str(), scene.cloth_faces, scene.faces.size()));
}

}  // namespace

int main(int argc, char** argv) {
  app::prepare_process();
  CLI::App app("Cloth by Newton's method with a barrier, every step of it filtered by onset");
  Arguments arguments;
  add_options(app, arguments);
  CLI11_PARSE(app, argc, argv);
  try {
    return run(arguments);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "onset_cloth: %s\n", e.what());
    return 1;
  }
}
