// onset_elastic: implicit elastodynamics of tetrahedral bodies, as a client of the library.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <optional>

#include "elastic/stepper.hpp"
#include "files/interrupts.hpp"
#include "files/output.hpp"

namespace {

struct Arguments {
  elastic::SceneOptions scene;
  std::string contact = "barrier";
  simulation::RunOptions run;
  elastic::Settings settings;
};

void add_options(CLI::App& app, Arguments& a) {
  app.add_option("--scene", a.scene.name, "torus, bars, pile or drop")
      ->check(CLI::IsMember({"torus", "bars", "pile", "drop"}))
      ->capture_default_str();
  app.add_option("--contact", a.contact, "barrier, or active-set: constraints in quadratic programs")
      ->check(CLI::IsMember({"active-set", "barrier"}))
      ->capture_default_str();
  app.add_option("--tetrahedra", a.scene.tetrahedra, "Of the bodies that move, about")
      ->check(CLI::Range(100, 1000000))
      ->capture_default_str();
  app.add_option("--mesh", a.scene.mesh, "The body of scene drop: Gmsh's MSH 2.2 or 4.1, ascii")
      ->type_name("FILE");
  app.add_option("--seed", a.scene.seed, "Of the turns at the start")
      ->check(simulation::count())
      ->capture_default_str();
  app.add_option("--time-step", a.settings.time_step, "Seconds")
      ->check(simulation::positive())
      ->capture_default_str();
  app.add_option("--friction", a.settings.friction, "Coefficient")
      ->check(simulation::not_negative())
      ->capture_default_str();
  app.add_option("--young", a.settings.material.young, "Young's modulus, Pa")
      ->check(simulation::positive())
      ->capture_default_str();
  app.add_option("--separation", a.settings.separation,
                 "Metres that constraints keep; the barrier reaches twice as far")
      ->check(simulation::positive())
      ->capture_default_str();
  simulation::add_run_options(app, a.run);
  simulation::add_filter_options(app, a.settings.filter);
}

int run(Arguments a) {
  a.settings.contact =
      a.contact == "barrier" ? elastic::ContactMethod::barrier : elastic::ContactMethod::active_set;
  const elastic::Scene scene = elastic::make_scene(a.scene);
  std::optional<simulation::State> start;
  if (!a.run.restart.empty())
    start = simulation::read_frame(a.run.restart, scene.vertices(), simulation::Cells(scene.tetrahedra));
  elastic::Stepper stepper(scene, a.settings, start);
  return simulation::run(stepper, a.run,
                         app::format("scene            %s, %zu tetrahedra, %zu vertices, %zu faces of the "
                                     "surface\ncontact          %s\n",
                                     a.scene.name.c_str(), scene.tetrahedra.size(), scene.vertices(),
                                     stepper.faces().size(), a.contact.c_str()));
}

}  // namespace

int main(int argc, char** argv) {
  app::prepare_process();
  CLI::App app("Elastic bodies by Newton's method, every step of it filtered by onset");
  Arguments arguments;
  add_options(app, arguments);
  CLI11_PARSE(app, argc, argv);
  try {
    return run(arguments);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "onset_elastic: %s\n", e.what());
    return 1;
  }
}
