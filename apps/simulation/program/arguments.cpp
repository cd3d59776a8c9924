#include "simulation/program/arguments.hpp"

namespace simulation {

void add_run_options(CLI::App& app, RunOptions& run) {
  app.add_option("--steps", run.steps, "Time steps, until which the run goes")
      ->check(count())
      ->capture_default_str();
  app.add_option("--restart", run.restart, "Go on from this frame of a run with the same options")
      ->type_name("FRAME");
  app.add_option("--out", run.out,
                 "A frame a step goes into this folder, as .vtu and .ply, and the series of them, series.pvd")
      ->type_name("FOLDER");
  app.add_option("--json", run.json, "A line a step goes into this file")->type_name("FILE");
  app.add_flag("--check", run.check,
               "Look for intersections in every frame by exact predicates; exit status 1 if any");
}

void add_filter_options(CLI::App& app, FilterSettings& filter) {
  onset::Options& options = filter.options;
  app.add_option("--threads", options.threads, "Of the collision phase; 0: all there are")
      ->check(count())
      ->capture_default_str();
  app.add_option("--relative-tolerance", options.relative_tolerance, "Of the collision phase")
      ->check(positive())
      ->capture_default_str();
  app.add_option_function<std::string>(
         "--certainty",
         [&](const std::string& word) {
           options.exactness = word == "conservative" ? onset::Exactness::conservative
                               : word == "exact"      ? onset::Exactness::exact
                                                      : onset::Exactness::certify;
         },
         "conservative, certify or exact")
      ->check(CLI::IsMember({"conservative", "certify", "exact"}))
      ->default_str("certify");
  app.add_option_function<std::string>(
         "--narrow-phase",
         [&](const std::string& word) {
           options.narrow_phase = word == "inclusion" ? onset::NarrowPhaseMethod::inclusion
                                                      : onset::NarrowPhaseMethod::automatic;
         },
         "automatic, or inclusion: the root finder alone")
      ->check(CLI::IsMember({"automatic", "inclusion"}))
      ->default_str("automatic");
  app.add_option("--gap-share", filter.gap_share, "That each pair keeps of its gap in a line search")
      ->check(share())
      ->capture_default_str();
  app.add_flag("--per-vertex", filter.per_vertex, "A step for each vertex in the place of one for all");
  app.add_option("--collision-server", filter.server,
                 "A program that says how far each step may go, in the place of the library "
                 "(apps/simulation/collision_server.hpp)")
      ->type_name("COMMAND");
}

}  // namespace simulation
