// onset_cloth: an implicit cloth simulator of a few hundred lines, as a client of the library.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <optional>

#include "cloth/output.hpp"
#include "files/interrupts.hpp"
#include "files/output.hpp"
#include "simulation/arguments.hpp"
#include "simulation/intersections.hpp"
#include "simulation/output.hpp"

namespace {

struct Arguments {
  std::string scene = "sphere", out, json;
  int triangles = 2000, steps = 100;
  unsigned seed = 1;
  bool check = false;
  cloth::Settings settings;
};

void add_options(CLI::App& app, Arguments& a) {
  app.add_option("--scene", a.scene, "sphere, twist, pile or ground")
      ->check(CLI::IsMember({"sphere", "twist", "pile", "ground"}))
      ->capture_default_str();
  app.add_option("--triangles", a.triangles, "Of the cloth, about")
      ->check(CLI::Range(40, 1000000))
      ->capture_default_str();
  app.add_option("--steps", a.steps, "Time steps")->check(simulation::count())->capture_default_str();
  app.add_option("--seed", a.seed, "Of the ripples and turns at the start")
      ->check(simulation::count())
      ->capture_default_str();
  app.add_option("--time-step", a.settings.time_step, "Seconds")
      ->check(simulation::positive())
      ->capture_default_str();
  app.add_option("--friction", a.settings.friction, "Coefficient")
      ->check(simulation::not_negative())
      ->capture_default_str();
  app.add_option("--threads", a.settings.options.threads, "Of the collision phase; 0: all there are")
      ->check(simulation::count())
      ->capture_default_str();
  app.add_option("--out", a.out, "A frame a step goes into this folder")->type_name("FOLDER");
  app.add_option("--json", a.json, "A line a step goes into this file")->type_name("FILE");
  app.add_flag("--check", a.check,
               "Look for intersections in every frame by exact predicates; exit status 1 if any");
}

class Outputs {
 public:
  explicit Outputs(const Arguments& a) : folder_(a.out) {
    if (!folder_.empty()) std::filesystem::create_directories(folder_);
    if (!a.json.empty()) json_.emplace(a.json);
  }
  void frame(int step, const cloth::Vector& x, const cloth::Scene& scene) const {
    if (folder_.empty()) return;
    simulation::write_ply_frame(simulation::frame_path(folder_, step, "ply"), x, scene.faces);
  }
  void line(int step, const cloth::StepReport& report) {
    if (json_) json_->write(cloth::json_line(step, report) + "\n");
  }
  void finish() {
    if (json_) json_->publish();
  }

 private:
  std::string folder_;
  std::optional<app::Output> json_;
};

struct Summary {
  int steps = 0, intersecting = 0, converged = 0, iterations = 0;
  double smallest = 1, collision = 0, seconds = 0, closest = INFINITY;
  std::size_t most_contacts = 0;

  void add(const cloth::StepReport& r) {
    ++steps, converged += r.converged, iterations += r.iterations;
    smallest = std::min(smallest, r.smallest_step), closest = std::min(closest, r.closest);
    collision += r.seconds_collision, seconds += r.seconds;
    most_contacts = std::max(most_contacts, r.contacts);
  }
  void print(const Arguments& a, const cloth::Scene& scene) const {
    std::printf("scene            %s, %zu triangles of cloth, %zu in all\n", a.scene.c_str(),
                scene.cloth_faces, scene.faces.size());
    std::printf("steps            %d, %d converged, %d iterations of Newton's method\n", steps, converged,
                iterations);
    std::printf("smallest step    %.3g allowed by the line search\n", smallest);
    std::printf("most contacts    %zu, closest %.3g m\n", most_contacts, closest);
    std::printf("collision        %.3g s of %.3g s, %.1f %%\n", collision, seconds,
                100 * collision / seconds);
    if (a.check) std::printf("intersections    in %d of %d frames\n", intersecting, steps + 1);
  }
};

int run(const Arguments& a) {
  const cloth::Scene scene = cloth::make_scene(a.scene, a.triangles, a.seed);
  cloth::Stepper stepper(scene, a.settings);
  Outputs outputs(a);
  Summary summary;
  const auto look = [&](int step) {
    outputs.frame(step, stepper.x(), scene);
    if (a.check) summary.intersecting += simulation::intersects_itself(stepper.x(), scene.faces);
  };
  look(0);
  {
    const simulation::Bar bar(a.steps);
    for (int step = 1; step <= a.steps; ++step) {
      const cloth::StepReport report = stepper.step();
      summary.add(report);
      outputs.line(step, report);
      look(step);
      bar.show(step);
    }
  }
  outputs.finish();
  summary.print(a, scene);
  return summary.intersecting > 0;
}

}  // namespace

int main(int argc, char** argv) {
  app::prepare_process();
  CLI::App app("Cloth by Newton's method with a barrier, every step filtered by onset::LineSearch");
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
