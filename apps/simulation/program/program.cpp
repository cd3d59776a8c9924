#include "simulation/program/program.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "files/output.hpp"
#include "simulation/intersections.hpp"
#include "simulation/program/output.hpp"

namespace simulation {
namespace {

std::string json_line(const StepReport& r) {
  nlohmann::ordered_json line = {{"step", r.step},
                                 {"iterations", r.iterations},
                                 {"converged", r.converged},
                                 {"toi", r.toi},
                                 {"smallest_step", r.smallest_step},
                                 {"stalls", r.stalls},
                                 {"stalled_by", r.stalled_by},
                                 {"behind", r.behind},
                                 {"contacts", r.contacts},
                                 {"closest", r.closest},
                                 {"energy", r.energy},
                                 {"height", r.height}};
  if (r.least_volume) line["least_volume"] = *r.least_volume;
  if (r.constraints) {
    line["constraints"] = r.constraints->rows;
    line["programs"] = r.constraints->programs;
    line["softened"] = r.constraints->softened;
  }
  line["seconds_assembly"] = r.seconds_assembly;
  line["seconds_solve"] = r.seconds_solve;
  line["seconds_collision"] = r.seconds_collision;
  line["seconds"] = r.seconds;
  return line.dump() + "\n";
}

class Outputs {
 public:
  Outputs(const RunOptions& options, double time_step) : folder_(options.out), time_step_(time_step) {
    if (!folder_.empty()) std::filesystem::create_directories(folder_);
    if (!options.json.empty()) json_.emplace(options.json);
  }
  // The series has the frames before that are there too, so that a restart continues it.
  void frame(const Simulation& simulation) {
    if (folder_.empty()) return;
    const State& state = simulation.state();
    if (steps_.empty())
      for (int before = 0; before < state.step; ++before)
        if (std::filesystem::exists(frame_path(folder_, before, "vtu"))) steps_.push_back(before);
    steps_.push_back(state.step);
    write_ply_frame(frame_path(folder_, state.step, "ply"), state.x, simulation.faces());
    write_frame(frame_path(folder_, state.step, "vtu"), state, simulation.cells());
    write_series((std::filesystem::path(folder_) / "series.pvd").string(), steps_, time_step_);
  }
  void line(const StepReport& report) {
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

class Summary {
 public:
  void look(const Simulation& s) {
    ++frames_;
    const std::string found = intersection_in_words(s.state().x, s.faces(), s.planes());
    if (!found.empty() && intersecting_++ == 0)
      first_ = "step " + std::to_string(s.state().step) + ": " + found;
  }
  void add(const StepReport& r) {
    ++steps_, converged_ += r.converged, iterations_ += r.iterations;
    smallest_ = std::min(smallest_, r.smallest_step), closest_ = std::min(closest_, r.closest);
    if (r.stalls > 0 && stalls_ == 0) stalled_ = "step " + std::to_string(r.step) + ": " + r.stalled_by;
    stalls_ += r.stalls;
    if (r.constraints) {
      programs_ += r.constraints->programs, softened_ += r.constraints->softened;
      most_rows_ = std::max(most_rows_, r.constraints->rows);
    }
    if (r.least_volume) least_volume_ = std::min(least_volume_, *r.least_volume);
    collision_ += r.seconds_collision, assembly_ += r.seconds_assembly, solve_ += r.seconds_solve;
    seconds_ += r.seconds;
    most_contacts_ = std::max(most_contacts_, r.contacts);
    height_ = r.height;
  }
  int print() const {
    std::printf("steps            %d, %d converged, %d iterations of Newton's method\n", steps_, converged_,
                iterations_);
    if (programs_ > 0)
      std::printf(
          "programs         %d, %zu rows at most, %d iterations with rows that could not all be kept\n",
          programs_, most_rows_, softened_);
    std::printf("smallest step    %.3g allowed by the filter\n", smallest_);
    if (stalls_ > 0) std::printf("stalls           %d, first in %s\n", stalls_, stalled_.c_str());
    std::printf("most contacts    %zu, closest %.3g m\n", most_contacts_, closest_);
    if (std::isfinite(least_volume_))
      std::printf("least volume     %.3g of an element's at rest\n", least_volume_);
    std::printf("height           %.6f m at the end\n", height_);
    std::printf("CPU seconds      %.3g: assembly %.3g, solution %.3g, collision %.3g\n", seconds_, assembly_,
                solve_, collision_);
    if (frames_ > 0) std::printf("intersections    in %d of %d frames\n", intersecting_, frames_);
    if (intersecting_ > 0) std::printf("                 first in %s\n", first_.c_str());
    return intersecting_ > 0;
  }

 private:
  int steps_ = 0, frames_ = 0, intersecting_ = 0, converged_ = 0, iterations_ = 0, stalls_ = 0;
  int programs_ = 0, softened_ = 0;
  double smallest_ = 1, collision_ = 0, assembly_ = 0, solve_ = 0, seconds_ = 0, height_ = 0;
  double closest_ = INFINITY, least_volume_ = INFINITY;
  std::size_t most_contacts_ = 0, most_rows_ = 0;
  std::string first_, stalled_;
};

}  // namespace

int run(Simulation& simulation, const RunOptions& options, const std::string& title) {
  Outputs outputs(options, simulation.time_step());
  Summary summary;
  const auto look = [&] {
    outputs.frame(simulation);
    if (options.check) summary.look(simulation);
  };
  look();
  {
    const int first = simulation.state().step;
    const Bar bar(std::max(0, options.steps - first));
    while (simulation.state().step < options.steps) {
      const StepReport report = simulation.step();
      summary.add(report);
      outputs.line(report);
      look();
      bar.show(report.step - first);
    }
  }
  outputs.finish();
  std::printf("%s", title.c_str());
  return summary.print();
}

}  // namespace simulation
