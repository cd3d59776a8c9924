// onset trade: what speed costs in accuracy on the user's own scene, and the other way round.
#include <CLI/CLI.hpp>
#include <memory>

#include "files/error.hpp"
#include "files/queries/truth_file.hpp"
#include "onset/command_line/arguments.hpp"
#include "onset/command_line/commands.hpp"
#include "onset/command_line/values.hpp"
#include "onset/results/progress.hpp"
#include "onset/trade/subject.hpp"
#include "onset/trade/trade_report.hpp"

namespace app {
namespace {

struct Inputs : Arguments {
  std::string a, b, kind;
  std::vector<std::string> queries, truth, axes = axis_names();
  SweepPlan plan;
  Target target;
};

std::unique_ptr<Subject> subject_of(const Inputs& inputs, const onset::Options& base) {
  if (inputs.queries.empty() == inputs.a.empty())
    throw UsageError("trade: either two frames A and B or --queries");
  if (!inputs.queries.empty()) {
    if (!inputs.truth.empty())
      throw UsageError("trade: --truth is for frames; queries have theirs with them");
    return query_subject(inputs.queries, inputs.kind, base);
  }
  if (inputs.b.empty()) throw UsageError("trade: B is missing");
  return scene_subject(inputs.a, inputs.b, inputs.truth, base);
}

std::vector<std::string> read_by(const Inputs& inputs) {
  std::vector<std::string> paths = truth_paths(inputs.truth);
  paths.insert(paths.end(), {inputs.a, inputs.b});
  for (const std::string& file : inputs.queries) paths.insert(paths.end(), {file, query_toi_path(file)});
  return paths;
}

void run_trade(const Inputs& inputs) {
  const onset::Options base = to_options(inputs);
  Outputs outputs(inputs, read_by(inputs));
  std::unique_ptr<Subject> subject;
  std::vector<Measured> measured;
  {
    Progress progress("trade, calls made");
    subject = subject_of(inputs, base);
    const std::vector<Setting> all = settings(base, inputs.axes, subject->grounds());
    measured = sweep(*subject, all, inputs.plan, [&] { progress.advance(); });
  }
  const TradeReport report{*subject, measured, pareto_front(measured), inputs.target,
                           inputs.target.any() ? recommended(measured, inputs.target) : std::nullopt};
  if (outputs.csv()) write_csv(*outputs.csv(), report);
  outputs.finish(to_json(report), describe(report));
}

void add_inputs(CLI::App& command, Inputs& inputs) {
  command.add_option("A", inputs.a, kMeshHelp)->check(path_fault);
  command.add_option("B", inputs.b, kEndHelp)->check(path_fault);
  command
      .add_option(
          "--queries", inputs.queries,
          "Instead of A and B, queries with truth: CSV, eight rows a query; exact times from a toi.csv "
          "beside the file, if there is one: a row lo,hi a query")
      ->check(path_fault)
      ->type_name("FILE ...");
  add_kind(command, inputs.kind);
  command
      .add_option("--truth", inputs.truth,
                  "Which pairs of A and B collide: PAIRS.json,COLLIDES.json, or a CSV with "
                  "kind,a,b,toi_lo,toi_hi; may be given several times")
      ->check(path_fault)
      ->type_name("FILE ...");
}

void add_plan(CLI::App& command, Inputs& inputs) {
  command.add_option("--axis", inputs.axes, "Only these axes around the base setting; all by default")
      ->check(CLI::IsMember(axis_names()))
      ->type_name("NAME,...")
      ->delimiter(',');
  add_whole(command, "--repeats", inputs.plan.repeats, "COUNT",
            "Measurements of each setting, after one to warm up [9]", 1, 1000);
  add_real(command, "--seconds", inputs.plan.seconds, "SECONDS",
           "Measure a setting again while it has not taken as long [5]", Zero::allowed);
}

void add_target(CLI::App& command, Target& target) {
  const std::string group = "Targets: recommend a setting of the Pareto front";
  const auto real = [&](const char* name, auto& value, const char* type, const char* help) {
    add_real(command, name, value, type, help, Zero::allowed)->group(group);
  };
  const auto count = [&](const char* name, auto& value, const char* help) {
    add_whole(command, name, value, "COUNT", help, 0, INT64_MAX)->group(group);
  };
  real("--target-time-us", target.time_us, "US", "The most accurate that takes no longer; else the fastest");
  count("--target-false-positives", target.false_positives, "No more false positives (needs the truth)");
  count("--target-positives", target.positives, "No more positives");
  real("--target-earliness", target.earliness, "TIME", "Times of impact no earlier on average, step = 1");
  count("--target-budget", target.budget, "No more pairs that spend max_checks");
}

}  // namespace

void add_trade(CLI::App& app, Run& run) {
  const auto inputs = std::make_shared<Inputs>();
  CLI::App* command = app.add_subcommand(
      "trade", "Tries the settings around the given ones: time, false positives, earliness, memory of each");
  add_inputs(*command, *inputs);
  add_plan(*command, *inputs);
  add_target(*command, inputs->target);
  add_common_options(*command, *inputs, "one row a setting");
  command->footer(
      "The other options make the base around which each axis is varied. False negatives are counted "
      "wherever the\n"
      "truth is known; there are none.");
  command->callback([&run, inputs] { run = [inputs] { run_trade(*inputs); }; });
}

}  // namespace app
