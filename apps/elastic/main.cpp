// onset_elastic: implicit elastodynamics of tetrahedral bodies, as a client of the library.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "elastic/quadratic_program.hpp"
#include "elastic/stepper.hpp"
#include "files/interrupts.hpp"
#include "files/output.hpp"
#include "simulation/arguments.hpp"
#include "simulation/intersections.hpp"
#include "simulation/output.hpp"

namespace {

struct Arguments {
  elastic::SceneOptions scene;
  std::string contact = "barrier", out, json, restart;
  int steps = 100;
  bool check = false;
  elastic::Settings settings;
};

void add_options(CLI::App& app, Arguments& a) {
  app.add_option("--scene", a.scene.name, "torus, bars, pile or drop")
      ->check(CLI::IsMember({"torus", "bars", "pile", "drop"}))
      ->capture_default_str();
  app.add_option(
         "--contact", a.contact,
         "barrier, or active-set: constraints in quadratic programs, where the program was built with a "
         "solver of them")
      ->check(CLI::IsMember({"active-set", "barrier"}))
      ->capture_default_str();
  app.add_option("--tetrahedra", a.scene.tetrahedra, "Of the bodies that move, about")
      ->check(CLI::Range(100, 1000000))
      ->capture_default_str();
  app.add_option("--mesh", a.scene.mesh, "The body of scene drop: Gmsh's MSH 2.2 or 4.1, ascii")
      ->type_name("FILE");
  app.add_option("--steps", a.steps, "Time steps, until which the run goes")
      ->check(simulation::count())
      ->capture_default_str();
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
  app.add_option("--threads", a.settings.options.threads, "Of the collision phase; 0: all there are")
      ->check(simulation::count())
      ->capture_default_str();
  app.add_option("--restart", a.restart, "Go on from this frame of a run with the same options")
      ->type_name("FRAME");
  app.add_option("--out", a.out, "A frame a step goes into this folder, and series.pvd")->type_name("FOLDER");
  app.add_option("--json", a.json, "A line a step goes into this file")->type_name("FILE");
  app.add_flag("--check", a.check,
               "Look for intersections in every frame by exact predicates; exit status 1 if any");
}

std::string json_line(const elastic::StepReport& r) {
  const nlohmann::ordered_json line = {{"step", r.step},
                                       {"iterations", r.iterations},
                                       {"converged", r.converged},
                                       {"toi", r.toi},
                                       {"smallest_step", r.smallest_step},
                                       {"contacts", r.contacts},
                                       {"closest", r.closest},
                                       {"constraints", r.constraints},
                                       {"programs", r.programs},
                                       {"softened", r.softened},
                                       {"behind", r.behind},
                                       {"energy", r.energy},
                                       {"height", r.height},
                                       {"least_volume", r.least_volume},
                                       {"seconds_assembly", r.seconds_assembly},
                                       {"seconds_solve", r.seconds_solve},
                                       {"seconds_collision", r.seconds_collision},
                                       {"seconds", r.seconds}};
  return line.dump() + "\n";
}

class Outputs {
 public:
  explicit Outputs(const Arguments& a) : folder_(a.out), time_step_(a.settings.time_step) {
    if (!folder_.empty()) std::filesystem::create_directories(folder_);
    if (!a.json.empty()) json_.emplace(a.json);
  }
  // The series has the frames before that are there too, so that a restart continues it.
  void frame(const elastic::Stepper& stepper) {
    if (folder_.empty()) return;
    const int step = stepper.state().step;
    if (steps_.empty())
      for (int before = 0; before < step; ++before)
        if (std::filesystem::exists(simulation::frame_path(folder_, before, "vtu"))) steps_.push_back(before);
    steps_.push_back(step);
    elastic::write_frame(simulation::frame_path(folder_, step, "vtu"), stepper.state(),
                         stepper.scene().tetrahedra);
    elastic::write_series((std::filesystem::path(folder_) / "series.pvd").string(), steps_, time_step_);
  }
  void line(const elastic::StepReport& report) {
    if (json_) json_->write(json_line(report));
  }
  void finish() {
    if (json_) json_->publish();
  }

 private:
  std::string folder_;
  double time_step_;
  std::vector<int> steps_;
  std::optional<app::Output> json_;
};

struct Summary {
  int steps = 0, frames = 0, intersecting = 0, converged = 0, iterations = 0, programs = 0, softened = 0;
  double smallest = 1, collision = 0, assembly = 0, solve = 0, seconds = 0, closest = INFINITY,
         least_volume = INFINITY;
  std::size_t most_contacts = 0, most_rows = 0;
  elastic::StepReport last;

  void add(const elastic::StepReport& r) {
    ++steps, converged += r.converged, iterations += r.iterations;
    programs += r.programs, softened += r.softened;
    smallest = std::min(smallest, r.smallest_step), closest = std::min(closest, r.closest);
    least_volume = std::min(least_volume, r.least_volume);
    collision += r.seconds_collision, assembly += r.seconds_assembly, solve += r.seconds_solve;
    seconds += r.seconds;
    most_contacts = std::max(most_contacts, r.contacts), most_rows = std::max(most_rows, r.constraints);
    last = r;
  }
  void print(const Arguments& a, const elastic::Stepper& stepper) const {
    std::printf("scene            %s, %zu tetrahedra, %zu vertices, %zu faces of the surface\n",
                a.scene.name.c_str(), stepper.scene().tetrahedra.size(), stepper.scene().vertices(),
                stepper.faces().size());
    std::printf("contact          %s\n", a.contact.c_str());
    std::printf("steps            %d, %d converged, %d iterations of Newton's method\n", steps, converged,
                iterations);
    if (a.contact == "active-set")
      std::printf(
          "programs         %d, %zu rows at most, %d iterations with rows that could not all be kept\n",
          programs, most_rows, softened);
    std::printf("smallest step    %.3g allowed by the line search\n", smallest);
    std::printf("most contacts    %zu, closest %.3g m\n", most_contacts, closest);
    std::printf("least volume     %.3g of an element's at rest\n", least_volume);
    std::printf("height           %.6f m at the end\n", last.height);
    std::printf("seconds          %.3g: assembly %.3g, solution %.3g, collision %.3g\n", seconds, assembly,
                solve, collision);
    if (a.check) std::printf("intersections    in %d of %d frames\n", intersecting, frames);
  }
};

bool intersects(const elastic::Stepper& stepper) {
  const elastic::Vector& x = stepper.state().x;
  return simulation::intersects_itself(x, stepper.faces()) ||
         simulation::is_behind_a_plane(x, stepper.scene().planes);
}

int run(Arguments a) {
  a.settings.contact =
      a.contact == "barrier" ? elastic::ContactMethod::barrier : elastic::ContactMethod::active_set;
  if (a.contact == "active-set" && !elastic::has_quadratic_solver())
    throw std::runtime_error("--contact active-set: built without ProxQP (docs/elastic.md)");
  const elastic::Scene scene = elastic::make_scene(a.scene);
  std::optional<elastic::State> start;
  if (!a.restart.empty()) start = elastic::read_frame(a.restart, scene.vertices(), scene.tetrahedra);
  elastic::Stepper stepper(scene, a.settings, start);
  Outputs outputs(a);
  Summary summary;
  const auto look = [&] {
    outputs.frame(stepper);
    ++summary.frames;
    if (a.check) summary.intersecting += intersects(stepper);
  };
  look();
  {
    const int first = stepper.state().step;
    const simulation::Bar bar(std::max(0, a.steps - first));
    while (stepper.state().step < a.steps) {
      const elastic::StepReport report = stepper.step();
      summary.add(report);
      outputs.line(report);
      look();
      bar.show(report.step - first);
    }
  }
  outputs.finish();
  summary.print(a, stepper);
  return summary.intersecting > 0;
}

}  // namespace

int main(int argc, char** argv) {
  app::prepare_process();
  CLI::App app("Elastic bodies by Newton's method, every step filtered by onset::LineSearch");
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
